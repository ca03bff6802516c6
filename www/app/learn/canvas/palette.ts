/** The colours of the page, for canvases. */
export interface Palette {
  paper: string;
  stage: string;
  raised: string;
  ink: string;
  dim: string;
  line: string;
  a: string;
  b: string;
  ab: string;
  good: string;
  bad: string;
  warn: string;
  /** Of the first and the second mode, or coefficient. */
  first: string;
  second: string;
  /** Family and pixels of small letters. */
  font: string;
  text: number;
}

const NAMES = [
  "paper",
  "stage",
  "raised",
  "ink",
  "dim",
  "line",
  "a",
  "b",
  "ab",
  "good",
  "bad",
  "warn",
  "first",
  "second",
] as const;

type Colours = Omit<Palette, "font" | "text">;

/** Kept, since a frame has no time to ask for styles again and again. */
const known = new Map<string, Colours>();

/** As the element has them: a theme, or larger letters, may be on above it. */
export function paletteOf(element: HTMLElement): Palette {
  const theme = document.documentElement.dataset.theme ?? "";
  const colours = known.get(theme) ?? coloursNow();
  known.set(theme, colours);
  const { fontFamily, fontSize } = getComputedStyle(element);
  return { ...colours, font: fontFamily, text: Number.parseFloat(fontSize) };
}

function coloursNow(): Colours {
  // Custom properties are not resolved to colours: a colour of an element is.
  const probe = document.createElement("i");
  probe.hidden = true;
  document.body.append(probe);
  const found: Record<string, string> = {};
  for (const name of NAMES) {
    probe.style.color = `var(--${name})`;
    found[name] = getComputedStyle(probe).color;
  }
  probe.remove();
  return found as unknown as Colours;
}

/** A colour of the palette, let through. */
export function faded(colour: string, opacity: number): string {
  return `color-mix(in srgb, ${colour} ${Math.round(100 * opacity)}%, transparent)`;
}
