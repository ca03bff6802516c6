/** A sentence whose numbers keep where in the report they come from. */

export interface ReportedNumber {
  /** Path in the report, as in `data-metric`. */
  metric: string;
  /** Unrounded. */
  value: number;
  text: string;
}

export type Phrase = (string | ReportedNumber)[];

export function reported(metric: string, value: number, text: string): ReportedNumber {
  return { metric, value, text };
}

export function plain(phrase: Phrase): string {
  return phrase.map((part) => (typeof part === "string" ? part : part.text)).join("");
}
