/** Reads from a link the visitor's own files that it names, which must be opened by hand. */

import { fileName } from "../models/address/address";
import type { LinkedModels } from "../state/linked-models";
import type { LinkState } from "./link";
import type { ExpectedModel, ExpectedRun } from "./runfile/expected";

/** The expected models of a link; null if all of them can be fetched. Pure. */
export function expectedByLink(link: LinkState): ExpectedRun | null {
  const { urls, hashes, parts, readings } = link;
  if (!urls || (urls.a !== null && urls.b !== null)) return null;
  const model = (side: "a" | "b"): ExpectedModel => {
    const name = askedName(link, side);
    return {
      name,
      source: urls[side],
      part: parts[side],
      reading: readings[side] ?? "",
      fingerprint: hashes[side],
    };
  };
  return {
    file: null,
    link,
    models: { a: model("a"), b: model("b") },
    settings: link.settings,
    engine: null,
    report: null,
  };
}

/** Name of a model as the link states it; null for a file whose name is left out. */
export function askedName({ urls, names }: LinkedModels, side: "a" | "b"): string | null {
  const address = urls?.[side] ?? null;
  return address === null ? names[side] : fileName(address.replace(/^demo:/, ""));
}
