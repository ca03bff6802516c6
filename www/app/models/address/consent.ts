/** Asks before a large file is downloaded. */
import { signal } from "@preact/signals";

/** Files up to this size are downloaded without asking. */
export const UNASKED_BYTES = 50e6;

export interface Question {
  name: string;
  host: string;
  /** Size; null if the host does not state it: more than UNASKED_BYTES. */
  bytes: number | null;
  answer: (yes: boolean) => void;
}

export const questions = signal<Question[]>([]);

/** Addresses that were agreed to: nobody is asked twice. */
const allowed = new Set<string>();

export function isAllowed(url: URL): boolean {
  return allowed.has(url.href);
}

/** Resolves if the download is wanted; rejects like a cancelled one if not. */
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
