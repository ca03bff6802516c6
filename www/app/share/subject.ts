/** Describes what the share dialog shares: the comparison, the scene of a lesson, or the gallery. */

import type { Side } from "../../worker/protocol";
import { headline } from "../comparison/words";
import { titleOf } from "../learn/scenes";
import { scene } from "../learn/state";
import { currentLink, unlinkable } from "../link/history";
import { nameOf } from "../models/sources";
import { nouns, page, result, settings, slots } from "../state/state";
import { plain } from "../text/phrase";
import { type CommandModel, commandOf } from "./command";
import { copiedWords, holdsSentences, type Unlinkable } from "./holds";

export interface Subject {
  /** Title of the dialog. */
  title: string;
  /** Accessible name of a frame. */
  name: string;
  /** What a frame shows. */
  framed: string;
  /** What the link contains. */
  holds: string[];
  copied: string;
  /** What a link cannot contain. */
  lost: Unlinkable;
  command: Line | null;
}

/** A command for the terminal, with the files that it needs and what it does not contain. */
export interface Line {
  text: string;
  /** Files that it needs. */
  files: string[];
  /** Settings that it does not contain. */
  missing: string[];
}

const NOTHING: Unlinkable = { files: [], modelList: false, shapes: false, points: false };

export function subject(): Subject {
  if (page.value === "learn") return scenePart();
  return page.value === "gallery" ? GALLERY : comparison();
}

const GALLERY: Subject = {
  title: "Share the gallery",
  name: "Shapevenn: gallery",
  framed: "A frame with the gallery.",
  holds: ["The link opens the gallery."],
  copied: copiedWords(NOTHING),
  lost: NOTHING,
  command: null,
};

function scenePart(): Subject {
  const { name, title } = titleOf(scene.value);
  const hasNumbers = name !== "yours" && name !== "teacher";
  const text = `shapevenn lesson '${currentLink()}'`;
  return {
    title: "Share this scene",
    name: `Shapevenn: ${title}`,
    framed: "A frame with the animated scene and a link to this page.",
    holds: [
      "The link contains the scene, its seed and its settings: everyone who opens it sees the same numbers.",
    ],
    copied: copiedWords(NOTHING),
    lost: NOTHING,
    command: hasNumbers ? { text, files: [], missing: [] } : null,
  };
}

function comparison(): Subject {
  const lost = unlinkable.value;
  const shown = result.value;
  const sentence = shown && `, the sentence “${plain(headline(shown.report, shown.nouns))}”`;
  return {
    title: "Share this comparison",
    name: `Shapevenn: ${nouns.value.a} and ${nouns.value.b}`,
    framed: `A frame with the shapes${sentence ?? ""} and a link to this page.`,
    holds: holdsSentences(lost),
    copied: copiedWords(lost),
    lost,
    command: comparing(),
  };
}

function comparing(): Line | null {
  const [a, b] = [commandModel("a"), commandModel("b")];
  if (!a || !b) return null;
  const { line, missing } = commandOf(settings.value, { a, b });
  const named = [a, b].flatMap(({ source, shapes }) => (shapes ? [source, shapes] : source));
  const files = named.filter((name) => !name.startsWith("demo:"));
  return { text: line, files: [...new Set(files)], missing };
}

function commandModel(side: Side): CommandModel | null {
  const slot = slots[side].value;
  if (!slot) return null;
  const { source, part, parts, reading, shapes } = slot;
  return {
    source: source.kind === "demo" ? `demo:${source.name}` : nameOf(source),
    part: part === parts[0] ? null : part,
    reading,
    shapes: shapes?.name ?? null,
  };
}
