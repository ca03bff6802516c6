/**
 * Serves dist/ the way a host must for threads: its headers on every response, worker scripts
 * included, and .wasm under its own type. `--no-isolation` leaves them out, as most
 * static hosts do.
 */
import { createReadStream } from "node:fs";
import { stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize, resolve, sep } from "node:path";
import { isMain, main, root, StepError } from "./steps/run.mjs";

const isolation = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
  // So that isolated pages of other sites may show this one in a frame.
  "Cross-Origin-Resource-Policy": "cross-origin",
};

/** Pages of other sites load shape-venn.js as a module, which takes this; GitHub Pages sends it on its own. */
const open = { "Access-Control-Allow-Origin": "*" };

const types = {
  ".css": "text/css; charset=utf-8",
  ".html": "text/html; charset=utf-8",
  ".ico": "image/x-icon",
  ".js": "text/javascript; charset=utf-8",
  ".json": "application/json; charset=utf-8",
  ".map": "application/json; charset=utf-8",
  ".mjs": "text/javascript; charset=utf-8",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".txt": "text/plain; charset=utf-8",
  ".wasm": "application/wasm",
  ".webp": "image/webp",
  ".woff2": "font/woff2",
};

/** The file that a request means, or null. Nothing outside `folder` is ever meant. */
async function fileFor(folder, url) {
  let path;
  try {
    path = decodeURIComponent(new URL(url, "http://host").pathname);
  } catch {
    return null;
  }
  if (path.includes("\0")) return null;
  let file = normalize(join(folder, path));
  if (file !== folder && !file.startsWith(folder + sep)) return null;
  let found = await stat(file).catch(() => null);
  if (found?.isDirectory()) {
    file = join(file, "index.html");
    found = await stat(file).catch(() => null);
  }
  return found?.isFile() ? { file, found } : null;
}

async function answer(folder, isolated, request, response) {
  const headers = { "Cache-Control": "no-cache", ...open, ...(isolated ? isolation : {}) };
  const refuse = (status, sentence) => {
    response.writeHead(status, { ...headers, "Content-Type": types[".txt"] }).end(`${sentence}\n`);
  };
  if (request.method !== "GET" && request.method !== "HEAD") return refuse(405, "Only GET.");
  const target = await fileFor(folder, request.url ?? "/");
  if (target === null) return refuse(404, "There is no such file.");
  const { file, found } = target;
  headers.ETag = `"${found.size.toString(36)}-${Math.floor(found.mtimeMs).toString(36)}"`;
  if (request.headers["if-none-match"] === headers.ETag)
    return response.writeHead(304, headers).end();
  headers["Content-Type"] = types[extname(file)] ?? "application/octet-stream";
  headers["Content-Length"] = found.size;
  response.writeHead(200, headers);
  if (request.method === "HEAD") return response.end();
  createReadStream(file)
    .on("error", () => response.destroy())
    .pipe(response);
}

/** Starts serving and resolves to `{url, port, close}`. Port 0 takes any free one. */
export async function serve({ folder = join(root, "dist"), isolated = true, port, host } = {}) {
  const home = resolve(folder);
  const server = createServer((request, response) => {
    answer(home, isolated, request, response).catch(() => response.destroy());
  });
  // Only this machine, unless asked: HOST=0.0.0.0 shares it.
  const address = host ?? process.env.HOST ?? "127.0.0.1";
  const wished = port ?? (process.env.PORT ? Number(process.env.PORT) : undefined);
  const taken = await listen(server, address, wished);
  return {
    url: `http://localhost:${taken}/`,
    port: taken,
    close: () =>
      new Promise((done) => {
        server.close(done);
        server.closeAllConnections();
      }),
  };
}

/** Takes the wished port; without a wish, the first free one from 8080 on. */
async function listen(server, host, wished) {
  if (wished !== undefined && !(Number.isInteger(wished) && wished >= 0 && wished < 65_536)) {
    throw new StepError(
      "PORT is not a port.",
      "use a number up to 65535, as in PORT=9000 npm start.",
    );
  }
  const first = wished ?? 8080;
  const last = wished ?? first + 100;
  for (let port = first; port <= last; port += 1) {
    try {
      await new Promise((done, fail) => {
        server.once("error", fail);
        server.listen(port, host, () => {
          server.off("error", fail);
          done();
        });
      });
      return server.address().port;
    } catch (error) {
      if (error.code !== "EADDRINUSE" && error.code !== "EACCES") throw error;
    }
  }
  throw new StepError(
    wished === undefined ? `Ports ${first} to ${last} are all taken.` : `Port ${wished} is taken.`,
    "set PORT to a free port, as in PORT=9000 npm start.",
  );
}

if (isMain(import.meta.url)) {
  await main(async () => {
    const isolated = !process.argv.includes("--no-isolation");
    const [folder] = process.argv.slice(2).filter((argument) => !argument.startsWith("--"));
    const { url } = await serve({ isolated, ...(folder ? { folder } : {}) });
    console.log(`Serving at ${url}`);
  });
}
