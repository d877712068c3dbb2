import type { Point } from "../../host/types.js";
import type { Chart } from "./chart.js";

/** Inputs of a plot. */
export interface Context {
  curve: (pass: string) => Float32Array;
  /** Azimuth and apparent elevation. */
  sun: Point;
  scatteringAngle: number | null;
  altitude: number;
  measured: import("../measured.js").Scan | null;
}

/** A plot's actions on the sky. */
export interface Links {
  moveSun: (chart: Chart) => void;
  point: (direction: Point | null) => void;
}

export interface Plot {
  title: string;
  help: string;
  passes: string[];
  node: HTMLElement;
  chart: Chart;
  update: (context: Context) => void;
  extra?: HTMLElement;
  hover?: (angle: number | null) => void;
  summary?: () => string;
}
