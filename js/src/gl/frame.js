/** The composited frame of one editor: pictures and scene in, pixels on a canvas out. */

import { graph as description, files } from "sunwidget:shaders/editor";
import { Surface } from "./surface.js";
import { states } from "./values.js";

/**
 * @typedef {import("../host/types.js").Edit} Edit
 * @typedef {import("../host/types.js").Parameter} Parameter
 * @typedef {import("../host/types.js").Scene} Scene
 * @typedef {import("./texture.js").Pixels} Pixels
 */

/** The scene textures that the analysis makes; the photo itself is one as well. */
export const MAPS = ["layers", "surface", "backdrop", "clear_sky", "relief", "transfer", "lamps"];

/**
 * Host uniforms of every frame: encode as sRGB, dither by half a level, show the whole picture.
 *
 * @type {import("./values.js").Values}
 */
const HOST = {
  output_transfer: 1,
  output_levels: 255,
  output_white: 1,
  dither: 0.5,
  view: [0, 0, 1, 1],
};

export class Frame extends Surface {
  /**
   * @param {HTMLCanvasElement} canvas the visible canvas
   * @param {Parameter[]} parameters the kernel's table
   */
  constructor(canvas, parameters) {
    super(canvas, description, files, { alpha: false });
    this.parameters = parameters;
    /** @type {Pick<Scene, "automatic" | "uniforms"> | null} */
    this.scene = null;
    this.host = { ...HOST };
  }

  /**
   * @param {string} name scene texture: photo or one of `MAPS`
   * @param {Pixels} pixels
   */
  setPicture(name, pixels) {
    this.setTexture(name, pixels);
  }

  /** @param {Pick<Scene, "automatic" | "uniforms">} scene */
  setScene(scene) {
    this.scene = scene;
  }

  /**
   * Return the graph's inputs for an edit at a size in pixels; null before there is a scene.
   *
   * @param {Edit} edit
   * @param {[number, number]} size
   * @returns {import("./graph.js").Frame | null}
   */
  describe(edit, size) {
    if (!this.scene) return null;
    const values = states(this.parameters, edit, this.scene.automatic);
    // Rows are drawn for a method, or for a parameter that is not zero.
    const used = Object.keys(values.edit).filter((name) => values.edit[name]);
    return {
      states: values,
      scene: this.scene.uniforms,
      host: this.host,
      size,
      methods: [String(edit.method ?? "ratio"), ...used],
    };
  }

  /**
   * Draw the edit at a size in pixels. Returns false if the context was lost: the canvas then keeps
   * its last frame, and another call draws again.
   *
   * @param {Edit} edit
   * @param {[number, number]} size
   */
  draw(edit, size) {
    const frame = this.describe(edit, size);
    return frame !== null && this.show(frame);
  }
}
