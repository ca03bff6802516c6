/** Reads the colours and the font of the page for drawing on canvases. */
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
  /** Colours of the first and the second mode or coefficient. */
  first: string;
  second: string;
  /** Font family and size in pixels. */
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

/** Cached: computing styles in every frame is too slow. */
const known = new Map<string, Colours>();

/** The colours and font of an element, which depend on the theme and the size of letters. */
export function paletteOf(element: HTMLElement): Palette {
  const theme = document.documentElement.dataset.theme ?? "";
  const colours = known.get(theme) ?? coloursNow();
  known.set(theme, colours);
  const { fontFamily, fontSize } = getComputedStyle(element);
  return { ...colours, font: fontFamily, text: Number.parseFloat(fontSize) };
}

function coloursNow(): Colours {
  // Browsers resolve the `color` of an element, but not custom properties.
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

/** A colour of the palette with an opacity. */
export function faded(colour: string, opacity: number): string {
  return `color-mix(in srgb, ${colour} ${Math.round(100 * opacity)}%, transparent)`;
}
