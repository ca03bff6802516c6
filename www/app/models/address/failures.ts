/** Error sentences about the address of a model or the answer of its host. Pure. */
import { EngineFailure } from "../../../worker/engine-errors";
import { bytes as size } from "../../text/format";
import type { Pointer } from "./lfs";

const DROP = "download it with the browser and drop it here";

function failure(code: string, message: string, hint: string): EngineFailure {
  return new EngineFailure({ code, message, hint });
}

export function noAddress(text: string): EngineFailure {
  return failure(
    "no-address",
    `“${text}” is not the address of a file; https://host/path/model.h5 was expected.`,
    "Copy the address of the file itself.",
  );
}

export function insecure({ href, hostname }: URL): EngineFailure {
  return failure(
    "insecure-address",
    `${href} is read without encryption: nobody can check that what arrives is what ${hostname} sent, and browsers refuse it on an encrypted page (mixed content).`,
    `Use https:// if ${hostname} has it; else ${DROP}.`,
  );
}

/** Error for hosts that are known not to let other sites read their files. */
export function keptFromOthers({ href }: URL, host: string): EngineFailure {
  return failure(
    "not-shared",
    `${href} cannot be read: other sites cannot read ${host} (no Access-Control-Allow-Origin header).`,
    `Open the address in a tab, ${DROP}; or put the file where other sites may read it, such as a repository on GitHub or a record on Zenodo.`,
  );
}

/** Error for an answer that cannot be read; browsers do not tell the reason. */
export function unread({ href, host }: URL, online: boolean): EngineFailure {
  if (!online) {
    return failure(
      "offline",
      `${href} cannot be downloaded: this computer is offline.`,
      "Try again once it is connected.",
    );
  }
  return failure(
    "not-shared",
    `${href} cannot be read. Most likely ${host} does not let other sites read its files (no Access-Control-Allow-Origin header); it may also not exist or not answer.`,
    `Open the address in a tab. If the file is there, ${DROP}, or put it on a host that allows it, such as GitHub or Zenodo.`,
  );
}

export function refused({ href, host }: URL, status: number): EngineFailure {
  if (status === 404 || status === 410) {
    return failure(
      "not-found",
      `${href} does not exist: ${host} answered ${status}.`,
      "Check the address, or ask the person who sent the link.",
    );
  }
  if (status === 401 || status === 403) {
    return failure(
      "forbidden",
      `${href} is not public: ${host} answered ${status}.`,
      `If you have access, ${DROP}; or make the file public.`,
    );
  }
  return failure(
    "download",
    `${href} cannot be downloaded: ${host} answered ${status}; 200 was expected.`,
    "Try again later.",
  );
}

export function webPage({ href }: URL): EngineFailure {
  return failure(
    "web-page",
    `${href} is a web page, not a file of a model.`,
    "Use the address behind the page’s download button; sites that ask for a login or a click first cannot be linked.",
  );
}

export function brokenOff({ href }: URL, arrived: number, of: number | null): EngineFailure {
  const whole = of === null ? "" : ` of ${size(of)}`;
  return failure(
    "broken-off",
    `The download of ${href} ended after ${size(arrived)}${whole}.`,
    "Check the connection and try again.",
  );
}

export function pointerOnly({ href }: URL, pointer: Pointer): EngineFailure {
  return failure(
    "lfs-pointer",
    `${href} is not the model but a Git LFS pointer to it: the file of ${size(pointer.size)} is stored elsewhere.`,
    `Use the address of the page’s own download button, or ${DROP}.`,
  );
}

export function otherThanPointer(
  { href }: URL,
  what: "size" | "SHA-256",
  expected: string,
  found: string,
): EngineFailure {
  return failure(
    "lfs-content",
    `${href} is not what its Git LFS pointer says: ${what} ${expected} was expected, ${found} arrived.`,
    "Try again. If it fails again, the repository is damaged: tell its owner.",
  );
}
