/** Shapes of what travels between kernel and browser. */

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
  /** The photo's maps follow it: the kernel answers a change with a new scene. */
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

/** What the analysis found, as far as the browser needs it (trait `_scene`). */
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
  /** How likely the fitted atmosphere is right, 0–1; null when none was fitted. */
  sureness: number | null;
  /** Shares of the sky by bins of whiteness from 0 to reach, as the method measures it. */
  whiteness: { method: string; reach: number; shares: number[] };
  /** Times of day, with what each sets in this photo. */
  presets: import("../ui/chips.js").Preset[];
  notes: { about: string; text: string }[];
}

/** The photo's own sun. */
export interface PhotoSun {
  /** A person told where it is, or that nothing in the picture is it ("outside"). */
  source: "found" | "told" | "outside" | "unseen";
  /** In fractions of the picture; null where its place is only assumed. */
  at: Point | null;
  visible: boolean;
  /** Degrees, of the assumed one where there is no other. */
  azimuth: number;
  elevation: number;
  /** How likely it is, or is there, 0–1; 1 where nothing measured it. */
  confidence: number;
  /** What lights a night in its stead, in fractions of the picture. */
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

/** Where the kernel's work stands (trait `_status`). */
export interface Status {
  stage: "opening" | "analysing" | "ready" | "cancelled" | "error";
  fraction: number;
  message: string;
}

export interface History {
  past: Edit[];
  future: Edit[];
}

/** An edit that was kept by name (trait `_versions`). */
export interface Version {
  name: string;
  recipe: Edit;
}

/** An edit with all that belongs to it, as it outlives page and kernel. */
export interface Kept extends History {
  recipe: Edit;
  versions: Version[];
  keyFrames: import("../film/film_path.js").KeyFrame[];
}

/** Which photo it is (trait `_source`). */
export interface Preset {
  label: string;
  title: string;
  values: Record<string, unknown>;
}

export interface Source {
  name: string;
  /** Of the photo's pixels. */
  fingerprint: string;
  /** Of the widget: another one after the cell has run again. */
  session: string;
}

/** The part of anywidget's model that is used. */
export interface Model {
  get(name: string): any;
  set(name: string, value: unknown): void;
  save_changes(): void;
  send(content: unknown, callbacks?: unknown, buffers?: ArrayBuffer[]): void;
  on(event: string, callback: (...args: any[]) => void): void;
  off(event: string, callback: (...args: any[]) => void): void;
  /** Where the host is ipywidgets. */
  widget_manager?: unknown;
}
