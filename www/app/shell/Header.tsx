import { redo, redoable, undo, undoable } from "../link/history";
import { chooseDemo } from "../models/opening";
import { sharing } from "../share/ShareDialog";
import { DEMO_GROUPS, findDemo } from "../state/demos";
import { demo, page, painting } from "../state/state";
import { isDark, toggleTheme } from "../state/theme";
import { MoonIcon, RedoIcon, ShareIcon, SunIcon, UndoIcon } from "../ui/icons";
import { Pages } from "./Pages";

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
      <Pages />
      <div class="tools">
        <UndoButtons />
        {page.value === "compare" && <DemoChooser />}
        <button
          type="button"
          class="quiet share-button"
          aria-label="Share"
          onClick={() => {
            sharing.value = true;
          }}
        >
          <ShareIcon />
          <span>Share</span>
        </button>
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

const MAC = /Mac|iPhone|iPad/.test(navigator.platform);

/** Buttons for undo and redo; disabled while painting, which has its own. */
function UndoButtons() {
  const paints = painting.value !== null;
  return (
    <fieldset class="undo" aria-label="Steps">
      <button
        type="button"
        class="quiet icon-only"
        disabled={!undoable.value || paints}
        onClick={undo}
        aria-label="Undo"
        aria-keyshortcuts="Control+Z Meta+Z"
        title={MAC ? "Undo (⌘Z)" : "Undo (Ctrl+Z)"}
      >
        <UndoIcon />
      </button>
      <button
        type="button"
        class="quiet icon-only"
        disabled={!redoable.value || paints}
        onClick={redo}
        aria-label="Redo"
        aria-keyshortcuts="Control+Shift+Z Control+Y Meta+Shift+Z"
        title={MAC ? "Redo (⇧⌘Z)" : "Redo (Ctrl+Shift+Z)"}
      >
        <RedoIcon />
      </button>
    </fieldset>
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
