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
  /** Of chains, one after the other. */
  chains: readonly string[];
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

const CHAIN_COLOURS = 8;

type Colours = Omit<Palette, "font" | "text">;

/** To look colours up takes longer than to draw a frame: once a theme. */
const known = new Map<string, Colours>();

/** As the page has them; letters as large as those of the element. */
export function paletteOf(element: HTMLElement): Palette {
  const theme = document.documentElement.dataset.theme ?? "";
  const colours = known.get(theme) ?? lookUp();
  if (theme) known.set(theme, colours);
  const { fontFamily, fontSize } = getComputedStyle(element);
  return { ...colours, font: fontFamily, text: Number.parseFloat(fontSize) };
}

function lookUp(): Colours {
  // Custom properties are not resolved to colours: a colour of an element is.
  const probe = document.createElement("i");
  probe.hidden = true;
  document.body.append(probe);
  const colourOf = (name: string) => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const found = Object.fromEntries(NAMES.map((name) => [name, colourOf(name)]));
  const chains = Array.from({ length: CHAIN_COLOURS }, (_, i) => colourOf(`chain-${i}`));
  probe.remove();
  return { ...(found as unknown as Omit<Colours, "chains">), chains };
}

/** A colour of the palette, let through. */
export function faded(colour: string, opacity: number): string {
  return `color-mix(in srgb, ${colour} ${Math.round(100 * opacity)}%, transparent)`;
}
