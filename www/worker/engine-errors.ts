import type { Choice, Notice } from "./protocol";

/** What the engine throws: a notice, with readings of the file that would help where there are some. */
export interface EngineError extends Notice {
  choices?: Choice[];
}

/** An error of the engine as the page's promises reject with it. */
export class EngineFailure extends Error implements Notice {
  readonly code: string;
  readonly hint: string;
  readonly choices: Choice[];

  constructor(error: EngineError) {
    super(error.message);
    this.name = "EngineFailure";
    this.code = error.code;
    this.hint = error.hint;
    this.choices = error.choices ?? [];
  }
}

/** The engine throws plain `{code, message, hint}`, sometimes with `choices`; anything else is a panic or out of memory. */
export function isEngineError(thrown: unknown): thrown is EngineError {
  return (
    typeof thrown === "object" &&
    thrown !== null &&
    "code" in thrown &&
    "message" in thrown &&
    typeof thrown.code === "string" &&
    typeof thrown.message === "string"
  );
}

/** Whatever was thrown, as one sentence. */
export function sentenceOf(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}

export function wasAborted(thrown: unknown): boolean {
  return thrown instanceof DOMException && thrown.name === "AbortError";
}
