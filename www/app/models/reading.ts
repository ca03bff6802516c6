/** The words that say how a file is read, as the engine writes them: apart by blanks. Pure. */

export function hasWord(reading: string, word: string): boolean {
  return reading.split(" ").includes(word);
}

/** The reading with or without a word. */
export function withWord(reading: string, word: string, present: boolean): string {
  const others = reading.split(" ").filter((one) => one !== "" && one !== word);
  return (present ? [word, ...others] : others).join(" ");
}

/** What stands behind a key of the reading; null if the key is not there. */
export function wordOf(reading: string, key: string): string | null {
  const word = reading.split(" ").find((one) => one.startsWith(`${key}=`));
  return word === undefined ? null : word.slice(key.length + 1);
}

/** The reading with another value of a key; null or "" takes the key out. */
export function withValue(reading: string, key: string, value: string | null): string {
  const others = reading.split(" ").filter((one) => one !== "" && !one.startsWith(`${key}=`));
  return (value ? [...others, `${key}=${value}`] : others).join(" ");
}

/** A name or word in a condition, without the signs that part conditions (src/formats/condition.rs). */
export function escaped(text: string): string {
  const code = (letter: string) =>
    [...new TextEncoder().encode(letter)]
      .map((byte) => `%${byte.toString(16).toUpperCase().padStart(2, "0")}`)
      .join("");
  return text.replace(/^!|[\s,:<>=%]/gu, code);
}
