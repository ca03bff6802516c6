/** The words that say how a file is read, as the engine writes them: apart by blanks. Pure. */

export function hasWord(reading: string, word: string): boolean {
  return reading.split(" ").includes(word);
}

/** The reading with or without a word. */
export function withWord(reading: string, word: string, present: boolean): string {
  const others = reading.split(" ").filter((one) => one !== "" && one !== word);
  return (present ? [word, ...others] : others).join(" ");
}
