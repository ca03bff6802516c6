/** Asks before a large file is downloaded. */
import { signal } from "@preact/signals";

/** Models of teaching size come without a question. */
export const UNASKED_BYTES = 50e6;

export interface Question {
  name: string;
  host: string;
  /** Null where the host does not say: more than UNASKED_BYTES. */
  bytes: number | null;
  answer: (yes: boolean) => void;
}

export const questions = signal<Question[]>([]);

/** As long as the page lives nobody is asked twice about the same address. */
const allowed = new Set<string>();

export function isAllowed(url: URL): boolean {
  return allowed.has(url.href);
}

/** Resolves once the download is wanted; rejects as a cancelled one does where it is not. */
export async function askFirst(signal: AbortSignal, url: URL, name: string, bytes: number | null) {
  signal.throwIfAborted();
  let put: Question | null = null;
  try {
    const yes = await new Promise<boolean>((answer) => {
      put = { name, host: url.host, bytes, answer };
      questions.value = [...questions.peek(), put];
      signal.addEventListener("abort", () => answer(false), { once: true });
    });
    if (!yes) throw new DOMException("Not now.", "AbortError");
    allowed.add(url.href);
  } finally {
    questions.value = questions.peek().filter((question) => question !== put);
  }
}
