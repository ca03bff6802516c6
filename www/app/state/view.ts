/** Types and defaults of the view in a link: page, tab, map, region, camera. */
import type { DifferenceShapes, MapName, Region, Settings } from "../../worker/protocol";
import { type Camera, HOME } from "./camera";
import { FIRST_DEMO } from "./demos";
import { DEFAULTS } from "./settings";

export type ViewMode = "contrast" | "pairs" | "mean" | "samples" | "sd";
export const VIEW_MODES: ViewMode[] = ["contrast", "pairs", "mean", "samples", "sd"];
/** Whether a map colours the vertices. */
export const isColoured = (mode: ViewMode) =>
  mode === "contrast" || mode === "pairs" || mode === "sd";
/** The pages: comparison, lessons, gallery. */
export type PageName = "compare" | "learn" | "gallery";
export const PAGES: PageName[] = ["compare", "learn", "gallery"];
/** The tabs of a comparison. */
export type Tab = "regions" | "explore" | "measures" | "evidence" | "diagnostics" | "models";
export const TABS: Tab[] = ["regions", "explore", "measures", "evidence", "diagnostics", "models"];
/** The maps of the view "sd"; older links have only that of standard deviations. */
export const MAPS: MapName[] = [
  "sd",
  "sd-normal",
  "sd-tangential",
  "distance",
  "reach",
  "offset",
  "chance",
  "means",
  "ratio",
  "mode",
];
export const PICTURES: DifferenceShapes[] = ["draws", "exclusiveModes"];
/** Largest exaggeration of the slider. */
export const MOST_EXAGGERATION = 5;

/** The view. */
export interface ViewState {
  page: PageName;
  /** Whether the page is a frame in another page, with shapes and a caption but without settings. */
  embed: boolean;
  /** An example pair, unless the models are given one by one. */
  demo: string;
  settings: Settings;
  tab: Tab;
  view: ViewMode;
  map: MapName;
  /** Mode of the map "mode", from 0. */
  mapMode: number;
  /** The chosen vertex. */
  vertex: number | null;
  /** Range of the colours while it is locked. */
  scale: [number, number] | null;
  /** Model and coefficient, from 0, of the diagnostic plots; null for the worst. */
  side: "a" | "b" | null;
  coefficient: number | null;
  /** The region that is shown alone, if any. */
  region: Region | null;
  picture: DifferenceShapes;
  /** How much of what the other model misses is added to a shape of a difference. */
  exaggeration: number;
  /** Seed of the shapes shown in “Samples”. */
  shapes: string;
  /** Which shapes are shown in “Pairs”: 0 for the nearest to the other model, 100 for the furthest. */
  rank: number;
  camera: Camera;
}

export const FIRST_VIEW: ViewState = {
  page: "compare",
  embed: false,
  demo: FIRST_DEMO.id,
  settings: DEFAULTS,
  tab: "regions",
  view: "contrast",
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
  rank: 50,
  camera: HOME,
};
