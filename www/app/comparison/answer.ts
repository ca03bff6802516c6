/** The sentences of the engine's answer as phrases of the page: formats their numbers, names the models. Pure. */
import type { Name, Quantity, Report, Sentence, Topic } from "../../worker/protocol";
import type { Nouns } from "../state/demos";
import { capital, count, length, number, percent } from "../text/format";
import { type Phrase, reported } from "../text/phrase";

/** Text of a number of a sentence. */
function written(value: number, quantity: Quantity, unit: string): string {
  switch (quantity) {
    case "length":
      return length(value, unit);
    case "length-without-unit":
      return number(value);
    case "spread":
      return `${number(value, 1)}\u202f${unit}`;
    case "share":
      return percent(value);
    case "count":
      return count(value);
    case "p-value":
      return pText(value);
  }
}

/** The level of the answer, as the engine has it. */
const LEVEL = 0.05;

/** A p-value, with as many digits as it is judged by: one above the level is not written as the level. */
export function pText(p: number): string {
  if (p >= 0.1) return p.toFixed(2);
  if (p < 0.0005) return number(p, 1);
  let digits = 3;
  while (p > LEVEL && Number(p.toFixed(digits)) <= LEVEL && digits < 6) digits++;
  return p.toFixed(digits);
}

const NAMES: Record<Name, keyof Nouns> = {
  "model-a": "modelA",
  "model-b": "modelB",
  "shape-of-a": "shapeOfA",
  "shape-of-b": "shapeOfB",
  "shapes-of-a": "shapesOfA",
  "shapes-of-b": "shapesOfB",
};

export function phraseOf({ parts }: Sentence, nouns: Nouns, unit: string): Phrase {
  const phrase = parts.map((part) => {
    if (typeof part === "string") return part;
    if ("name" in part) return nouns[NAMES[part.name]];
    return reported(part.metric, part.value, written(part.value, part.quantity, unit));
  });
  const [first, ...rest] = phrase;
  return typeof first === "string" ? [capital(first), ...rest] : phrase;
}

/** The sentence about one of the topics; null where the report has none, as those of older engines. */
export function said(report: Report, nouns: Nouns, ...topics: Topic[]): Phrase | null {
  const found = report.answer?.find(({ about }) => topics.includes(about));
  return found ? phraseOf(found, nouns, report.models.a.unit) : null;
}

export const CHANCE: Topic[] = ["more-than-chance", "no-more-than-chance", "chance-unknown"];

/** What the report says about chance. */
export function chanceTopic(report: Report): Topic | null {
  return report.answer?.find(({ about }) => CHANCE.includes(about))?.about ?? null;
}
