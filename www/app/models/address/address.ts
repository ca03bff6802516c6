/** Turns the address of a model into that of its file, and refuses addresses that no page can read. Pure. */
import { insecure, keptFromOthers, noAddress } from "./failures";

/** Whether a value of `a=` or `b=` is an address: of the web, or relative to the page. */
export function looksLikeAddress(text: string): boolean {
  return /^https?:\/\/./i.test(text) || (/^[^\s:]/.test(text) && !/^[^/?#]*:/.test(text));
}

/** The address of the file; throws if no page can read it. `page` is the address of this page. */
export function fileAddress(text: string, page: string): URL {
  if (!looksLikeAddress(text) || !URL.canParse(text, page)) throw noAddress(text);
  const url = itself(new URL(text, page));
  // Files of the page's own site are as safe as the page.
  if (url.origin !== new URL(page).origin && !isTrustworthy(url)) throw insecure(url);
  return url;
}

/** Whether an address is secure as browsers define it: encrypted, or of this computer. */
function isTrustworthy({ protocol, hostname }: URL): boolean {
  if (protocol === "https:") return true;
  return /^(localhost|.+\.localhost|127(\.\d+){3}|\[::1\])$/.test(hostname);
}

interface Rule {
  host: RegExp;
  path: RegExp;
  /** Returns the address of the file from the parts of the path, or throws. */
  file: (parts: string[], page: URL) => string;
}

/**
 * Addresses of pages that show a file → the file. Only to hosts that send Access-Control-Allow-Origin: raw.githubusercontent.com,
 * gist.githubusercontent.com, huggingface.co/…/resolve, the `/api/` of GitLab (its `/-/raw/` does not: packagecontrol/thecrawl#204) and
 * that of Zenodo (its `/records/` does not: zenodo/zenodo#2593).
 */
const RULES: Rule[] = [
  {
    host: /^github\.com$/,
    path: /^\/([^/]+\/[^/]+)\/(?:blob|raw)\/(.+)$/,
    file: ([repository, path]) => `https://raw.githubusercontent.com/${repository}/${path}`,
  },
  {
    host: /^github\.com$/,
    path: /^\/[^/]+\/[^/]+\/releases\/(?:latest\/)?download\//,
    file: (_, page) => {
      throw keptFromOthers(page, "the release files of GitHub");
    },
  },
  {
    // The first file of the gist, unless one is named.
    host: /^gist\.github\.com$/,
    path: /^\/([^/]+\/[0-9a-f]{20,})(?:\/raw)?(\/.+)?\/?$/,
    file: ([gist, file = ""]) => `https://gist.githubusercontent.com/${gist}/raw${file}`,
  },
  {
    // A branch whose name holds a slash cannot be told from a folder: use its commit.
    host: /./,
    path: /^\/(.+?)\/-\/(?:blob|raw)\/([^/]+)\/(.+)$/,
    file: ([project = "", ref, path = ""], { origin }) =>
      `${origin}/api/v4/projects/${whole(project)}/repository/files/${whole(path)}/raw?ref=${ref}&lfs=true`,
  },
  {
    host: /^huggingface\.co$/,
    path: /^\/(.+)\/(?:blob|raw)\/([^/]+\/.+)$/,
    file: ([repository, path]) => `https://huggingface.co/${repository}/resolve/${path}`,
  },
  {
    host: /^(?:sandbox\.)?zenodo\.org$/,
    path: /^\/records?\/(\d+)\/(?:files|preview)\/(.+)$/,
    file: ([record, name], { origin }) => `${origin}/api/records/${record}/files/${name}/content`,
  },
  {
    host: /(^|\.)dropbox\.com$/,
    path: /./,
    file: (_, page) => {
      throw keptFromOthers(page, "shared files of Dropbox");
    },
  },
  {
    host: /^(?:drive|docs)\.google\.com$/,
    path: /./,
    file: (_, page) => {
      throw keptFromOthers(page, "files of Google Drive");
    },
  },
];

function itself(page: URL): URL {
  for (const { host, path, file } of RULES) {
    const found = host.test(page.hostname) ? path.exec(page.pathname) : null;
    if (found) return new URL(file(found.slice(1), page));
  }
  return page;
}

/** Escapes a path as one segment of another path; it may be escaped already. */
function whole(path: string): string {
  return encodeURIComponent(decoded(path));
}

/** Name of a file, taken from its address. */
export function fileName(address: string): string {
  const path = address.split(/[?#]/)[0] ?? "";
  const pieces = path.split("/").filter((piece) => piece !== "");
  // Where Zenodo has the file itself.
  if (pieces.at(-1) === "content" && pieces.at(-3) === "files") pieces.pop();
  return decoded(pieces.at(-1) ?? address);
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
