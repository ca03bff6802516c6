/** What is shown, as far as a link says it: page, tab, view, map, region, camera; and what is shown first. */
import type { MapName, Picture, Region, Settings } from "../../worker/protocol";
import { type Camera, HOME } from "./camera";
import { FIRST_DEMO } from "./demos";
import { DEFAULTS } from "./settings";

export type ViewMode = "mean" | "samples" | "sd";
export const VIEW_MODES: ViewMode[] = ["mean", "samples", "sd"];
/** What the page is for: to compare, to learn how that is done, to choose from what there is to see. */
export type PageName = "compare" | "learn" | "gallery";
export const PAGES: PageName[] = ["compare", "learn", "gallery"];
/** Parts of the page, each with its own look at the same comparison. */
export type Tab = "regions" | "explore" | "measures" | "diagnostics" | "models";
export const TABS: Tab[] = ["regions", "explore", "measures", "diagnostics", "models"];
/** What can be coloured onto the vertices in the view "sd", which older links know by that name alone. */
export const MAPS: MapName[] = [
  "sd",
  "sd-normal",
  "sd-tangential",
  "distance",
  "means",
  "ratio",
  "mode",
];
export const REGIONS: Region[] = ["a", "aWithoutB", "intersection", "bWithoutA", "b"];
export const PICTURES: Picture[] = ["draws", "exclusiveModes"];
/** As the slider has it. */
export const MOST_EXAGGERATION = 5;

/** What is looked at. */
export interface ViewState {
  page: PageName;
  /** Whether the page is a frame in another page: shapes and a caption, and nothing to set. */
  embed: boolean;
  /** A pair that comes with the page, unless the models are said one by one. */
  demo: string;
  settings: Settings;
  tab: Tab;
  view: ViewMode;
  map: MapName;
  /** Which mode the map "mode" is of, from 0. */
  mapMode: number;
  /** The vertex that is looked at. */
  vertex: number | null;
  /** Range of the colours while it is locked. */
  scale: [number, number] | null;
  /** Whose draws are diagnosed, and which coefficient, from 0; null for the worst. */
  side: "a" | "b" | null;
  coefficient: number | null;
  /** The region shown alone, if one is. */
  region: Region | null;
  picture: Picture;
  /** How much further a shape of a difference is pushed away from the other model. */
  exaggeration: number;
  /** Seed of the shapes shown in “Samples”. */
  shapes: string;
  camera: Camera;
}

export const FIRST_VIEW: ViewState = {
  page: "compare",
  embed: false,
  demo: FIRST_DEMO.id,
  settings: DEFAULTS,
  tab: "regions",
  view: "mean",
  map: "sd",
  mapMode: 0,
  vertex: null,
  scale: null,
  side: null,
  coefficient: null,
  region: null,
  picture: "draws",
  exaggeration: 0,
  shapes: "1",
  camera: HOME,
};
