/** The theme: light, dark, or that of the system. */
import { effect, signal } from "@preact/signals";
import { type Theme, theme } from "./state";

const STORE = "shapevenn-theme";
const THEMES: Theme[] = ["system", "light", "dark"];
const query = matchMedia("(prefers-color-scheme: dark)");
const systemDark = signal(query.matches);

export function isDark(): boolean {
  return theme.value === "system" ? systemDark.value : theme.value === "dark";
}

export function toggleTheme(): void {
  theme.value = isDark() ? "light" : "dark";
}

export function watchTheme(): void {
  query.addEventListener("change", () => {
    systemDark.value = query.matches;
  });
  const kept = remembered();
  if (kept) theme.value = kept;
  effect(() => {
    document.documentElement.dataset.theme = isDark() ? "dark" : "light";
    remember(theme.value);
  });
}

function remembered(): Theme | undefined {
  try {
    return THEMES.find((name) => name === localStorage.getItem(STORE));
  } catch {
    return undefined; // Storage may be forbidden in a frame.
  }
}

function remember(name: Theme): void {
  try {
    localStorage.setItem(STORE, name);
  } catch {
    // Without storage the choice lasts until the page is closed.
  }
}
