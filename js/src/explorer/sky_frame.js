/**
 * SkyExplorer's picture and curves on WebGL2. The kernel's twin is `sunwidget/explorer/draw.py`;
 * `docs/developer/frame-graph.md` says what the passes draw.
 */

import { graph as description, files } from "sunwidget:shaders/explorer";
import { Surface } from "../gl/surface.js";
import { effectiveValues } from "./values.js";

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {import("../gl/graph.js").Frame} Frame
 */

/** @type {import("../gl/values.js").Values} */
const HOST = { output_transfer: 1, dither: 0.5 };

export class SkyFrame extends Surface {
  /**
   * @param {HTMLCanvasElement} canvas the visible canvas; transparent around the dome
   * @param {Parameter[]} parameters the kernel's table
   */
  constructor(canvas, parameters) {
    super(canvas, description, files, { alpha: true });
    this.parameters = parameters;
    /** @type {Frame | null} what was drawn last */
    this.last = null;
  }

  /**
   * Draw the sky. Until a model's table is available, the multiple-scattering model replaces it.
   * Returns false if the context was lost: the canvas then keeps its last frame, and another call
   * draws again.
   *
   * @param {Edit} values by name; a missing one is at its default
   * @param {[number, number]} size in pixels
   */
  draw(values, size) {
    this.last = this.frame(values, size);
    return this.show(this.last);
  }

  /**
   * Return one pass's RGBA texels for the last drawn values; any pass except the picture.
   *
   * @param {string} name
   * @returns {Float32Array} empty if nothing was drawn yet or the context was lost
   */
  curve(name) {
    return (this.last && this.read(this.last, name)) ?? new Float32Array(0);
  }

  /**
   * Set the slice of Bruneton's table for the altitude, as sent by the kernel.
   *
   * @param {Float32Array} data four floats a texel
   * @param {number} rows
   * @param {number} columns
   */
  setBruneton(data, rows, columns) {
    this.setTexture("bruneton", { width: columns, height: rows, data });
  }

  /** Drop the table, as it belongs to other air: the multiple-scattering model replaces it. */
  forgetBruneton() {
    this.pictures.delete("bruneton");
  }

  /**
   * Return radiances at the four wavelengths in the given directions, by the last drawn model.
   *
   * @param {[number, number][]} directions azimuth and elevation in degrees
   * @returns {Float32Array | null} four numbers each; null if nothing was drawn yet
   */
  radiances(directions) {
    if (!this.last || !directions.length) return null;
    const data = new Float32Array(4 * directions.length);
    directions.forEach((angles, i) => {
      data.set(angles, 4 * i);
    });
    this.setTexture("directions", { width: directions.length, height: 1, data });
    this.last.sizes = { ...this.last.sizes, directions: [directions.length, 1] };
    return this.read(this.last, "curve_directions");
  }

  /** Paths per pixel that the reference has accumulated; every draw adds one. */
  get samples() {
    const traced = this.last?.methods.includes("reference");
    return traced ? (this.graph?.targets.latest.get("reference")?.samples ?? 0) : 0;
  }

  /**
   * @param {Edit} values
   * @param {[number, number]} size
   * @returns {Frame}
   */
  frame(values, size) {
    const states = effectiveValues(this.parameters, values);
    const choice = (/** @type {string} */ name) => {
      const row = this.parameters.find((p) => p.name === name);
      return String(values[name] ?? row?.default);
    };
    const [width, height] = choice("grid").split("×").map(Number);
    const methods = [choice("model"), choice("compare")];
    const { edit } = states;
    if (!edit.show_single || !edit.show_multiple) methods.push("orders");
    const table = this.pictures.get("directions");
    return {
      states,
      scene: {},
      host: HOST,
      size,
      sizes: {
        grid: [width, height],
        shown: [2 * width, height],
        directions: [table?.width ?? 1, 1],
      },
      methods: methods.filter((name) => name !== "bruneton" || this.pictures.has("bruneton")),
    };
  }
}
