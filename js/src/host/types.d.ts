/** Types of the data exchanged between kernel and browser. */

/** One row of the kernel's parameter tables (`sunwidget/edit/table.py`, `sunwidget/explorer/table.py`). */
export interface Parameter {
  name: string;
  kind: "number" | "choice" | "switch" | "data";
  default: number | string | boolean | null | unknown[];
  minimum: number;
  maximum: number;
  step: number;
  unit: string;
  label: string;
  section: string;
  help: string;
  choices: string[];
  advanced: boolean;
  /** Whether the photo's maps depend on it: the kernel answers a change with a new scene. */
  analysis: boolean;
}

export type Point = [number, number];

export interface Stroke {
  label: "sky" | "not_sky" | "water" | "not_water";
  points: Point[];
  radius: number;
}

/** Values by parameter name; a missing one is at its default, null is automatic. */
export type Edit = Record<string, unknown>;

/** The analysis, as far as the browser needs it (trait `_scene`). */
export interface Scene {
  width: number;
  height: number;
  camera: { fov_vertical_deg: number; pitch: number; roll: number };
  automatic: Record<string, number>;
  uniforms: Record<string, number | number[]>;
  sun: PhotoSun;
  horizon: {
    row: number;
    roll: number;
    confidence: number;
    source: string;
  };
  /** Probability that the fitted atmosphere is right, 0–1; null if none was fitted. */
  sureness: number | null;
  /** Shares of the sky by bins of whiteness from 0 to `reach`, as measured by the method. */
  whiteness: { method: string; reach: number; shares: number[] };
  /** Times of day, with the values that each sets in this photo. */
  presets: import("../ui/chips.js").Preset[];
  notes: { about: string; text: string }[];
}

/** The photo's own sun. */
export interface PhotoSun {
  /** "told": the user marked it; "outside": the user said that it is not in the picture. */
  source: "found" | "told" | "outside" | "unseen";
  /** In fractions of the picture; null if its position is only assumed. */
  at: Point | null;
  visible: boolean;
  /** Degrees; of the assumed sun if there is no other. */
  azimuth: number;
  elevation: number;
  /** Probability of the detection or of the assumed bearing, 0–1; 1 if not measured. */
  confidence: number;
  /** The moon that lights a night photo, in fractions of the picture. */
  moon: Point | null;
}

/** One row of the kernel's table of inspectable maps (`sunwidget/analysis/maps.py`). */
export interface SceneMap {
  name: string;
  title: string;
  help: string;
  ramp: [number, string][];
  low: number;
  high: number;
  unit: string;
  scale: "linear" | "log";
}

/** State of the kernel's work (trait `_status`). */
export interface Status {
  stage: "opening" | "analysing" | "ready" | "cancelled" | "error";
  fraction: number;
  message: string;
}

export interface History {
  past: Edit[];
  future: Edit[];
}

/** An edit kept by name (trait `_versions`). */
export interface Version {
  name: string;
  recipe: Edit;
}

/** An edit with its history, versions and key frames, stored beyond page and kernel. */
export interface Kept extends History {
  recipe: Edit;
  versions: Version[];
  keyFrames: import("../film/film_path.js").KeyFrame[];
}

export interface Preset {
  label: string;
  title: string;
  values: Record<string, unknown>;
}

/** Identifies the photo (trait `_source`). */
export interface Source {
  name: string;
  /** Of the photo's pixels. */
  fingerprint: string;
  /** Of the widget; new each time the cell runs. */
  session: string;
}

/** The part of anywidget's model that we use. */
export interface Model {
  get(name: string): any;
  set(name: string, value: unknown): void;
  save_changes(): void;
  send(content: unknown, callbacks?: unknown, buffers?: ArrayBuffer[]): void;
  on(event: string, callback: (...args: any[]) => void): void;
  off(event: string, callback: (...args: any[]) => void): void;
  /** Present if the host is ipywidgets. */
  widget_manager?: unknown;
}
