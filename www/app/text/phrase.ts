/** Sentences whose numbers keep their path in the report. */

export interface ReportedNumber {
  /** Path in the report, as in `data-metric`. */
  metric: string;
  /** The unrounded value. */
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
