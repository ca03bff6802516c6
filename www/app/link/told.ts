/** Says what was corrected in a link, and what is used instead of what cannot be used. */
import { findDemo } from "../state/demos";
import { FIELDS } from "../state/settings";
import { dismiss, notify, spoken } from "../state/state";
import { type LinkState, settingText } from "./link";
import { type LinkFault, readKeys } from "./reading";

const MODEL_KEYS = new Set(["demo", "a", "b"]);

/** Says it of the link that was read from this text, if there is something to say. */
export function tellLink(text: string, link: LinkState): void {
  const found = linkSentences(text, link);
  if (found === null) {
    dismiss("link");
    return;
  }
  const { code, message } = found;
  const hint = "The address stays as it is until you close this message or change something.";
  notify("link", code, message, hint);
  spoken.value = message;
}

/** The sentences, one a line; null if nothing was corrected and everything is used. Pure. */
export function linkSentences(
  text: string,
  link: LinkState,
): { code: "link-faults" | "link-repairs"; message: string } | null {
  const { faults, repairs, unclearModels } = readKeys(text);
  const ofModels = faults.filter(({ key }) => MODEL_KEYS.has(key));
  const models = [...ofModels.map(({ sentence }) => sentence), unclearModels ?? ""]
    .join(" ")
    .trim();
  const lines = models === "" ? [] : [`${models} ${shownInstead(link)}`];
  for (const fault of faults) {
    if (!ofModels.includes(fault)) lines.push(`${fault.sentence} ${consequence(fault, link)}`);
  }
  const code = lines.length > 0 ? "link-faults" : "link-repairs";
  if (repairs.length > 0) lines.push(`The link was corrected: ${repairs.join(" ")}`);
  return lines.length === 0 ? null : { code, message: lines.join("\n") };
}

/** What the page does where a key cannot be used. */
function consequence({ key, nearest }: LinkFault, link: LinkState): string {
  if (nearest) return "The nearest value is used instead.";
  const field = FIELDS.find((one) => one.key === key);
  if (field && link.page === "compare") {
    return `Used instead: ${settingText(link.settings[field.name], field.value.kind)}.`;
  }
  return "It is passed over.";
}

function shownInstead({ urls, demo }: LinkState): string {
  if (urls) return "The models that it names one by one are shown.";
  return `The example “${findDemo(demo)?.label ?? demo}” is shown instead.`;
}
