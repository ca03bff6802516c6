/** Hosts of files, good and bad, each on a port of its own: another site than the page. */
import { createServer } from "node:http";

/**
 * `files` maps a path to its bytes, or to `{status, type, bytes, length, wait}`: `length: null` sends no
 * Content-Length, `wait` holds the end of the file back until it resolves.
 */
export async function host(files, { cors = true } = {}) {
  const asked = [];
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://host");
    asked.push(pathname);
    const given = files[pathname] ?? { status: 404, bytes: Buffer.from("nothing here") };
    const file = Buffer.isBuffer(given) ? { bytes: given } : given;
    const { status = 200, type = "application/octet-stream", bytes, length, wait } = file;
    response.writeHead(status, {
      "Content-Type": type,
      ...(length === null ? {} : { "Content-Length": bytes.length }),
      ...(cors ? { "Access-Control-Allow-Origin": "*" } : {}),
    });
    const half = Math.floor(bytes.length / 2);
    response.write(bytes.subarray(0, half));
    await wait;
    response.end(bytes.subarray(half));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  // A test that fails before it closes this ends all the same.
  server.unref();
  return {
    url: `http://localhost:${server.address().port}`,
    asked,
    close: () => {
      server.closeAllConnections();
      return new Promise((done) => server.close(done));
    },
  };
}
