import { useSignal } from "@preact/signals";
import { DEMO_GROUPS, findDemo } from "../demos";
import { linkable, writeAddress } from "../history";
import { chooseDemo } from "../models";
import { demo, spoken } from "../state";
import { isDark, toggleTheme } from "../theme";
import { LinkIcon, MoonIcon, SunIcon } from "./icons";

export function Header() {
  return (
    <header class="top">
      <div class="brand">
        <svg class="mark" viewBox="0 0 40 26" aria-hidden="true">
          <circle cx="14" cy="13" r="11.5" class="mark-a" />
          <circle cx="26" cy="13" r="11.5" class="mark-b" />
        </svg>
        <h1>Shapevenn</h1>
        <p class="tagline">Which shapes can both models make?</p>
      </div>
      <div class="tools">
        <DemoChooser />
        <CopyLink />
        <button
          type="button"
          class="quiet icon-only"
          onClick={toggleTheme}
          aria-label={isDark() ? "Use the light theme" : "Use the dark theme"}
        >
          {isDark() ? <SunIcon /> : <MoonIcon />}
        </button>
      </div>
    </header>
  );
}

function DemoChooser() {
  const choose = (id: string) => {
    const found = findDemo(id);
    if (found) void chooseDemo(found);
  };
  return (
    <label class="chooser">
      <span class="chooser-label">Example</span>
      <select
        aria-label="Example"
        value={demo.value?.id ?? ""}
        onChange={(event) => choose(event.currentTarget.value)}
      >
        {demo.value === null && (
          <option value="" disabled>
            Your models
          </option>
        )}
        {DEMO_GROUPS.map((group) => (
          <optgroup key={group.label} label={group.label}>
            {group.demos.map(({ id, label }) => (
              <option key={id} value={id}>
                {label}
              </option>
            ))}
          </optgroup>
        ))}
      </select>
    </label>
  );
}

function CopyLink() {
  const said = useSignal("");
  const say = (text: string) => {
    said.value = text;
    spoken.value = text;
    setTimeout(() => {
      said.value = "";
    }, 2500);
  };
  const copy = async () => {
    writeAddress();
    try {
      await navigator.clipboard.writeText(location.href);
      say(linkable.value ? "Link copied" : "Copied; it cannot hold your files and lists");
    } catch {
      say("Copy it from the address bar");
    }
  };
  return (
    <button type="button" class="quiet" onClick={() => void copy()}>
      <LinkIcon />
      <span>{said.value || "Copy link"}</span>
    </button>
  );
}
