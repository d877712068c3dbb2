/**
 * Other edits of a surface's picture, drawn small beside it.
 *
 * They run on the surface's own context with its pictures and compiled shaders, but with targets
 * of their own: what the surface has drawn stays drawn, so that its next frame costs no more.
 */

import { Graph } from "./graph.js";

/** @typedef {import("./surface.js").Surface} Surface */

export class Sketch {
  /** @param {Surface} surface */
  constructor(surface) {
    this.surface = surface;
    /** @type {Graph | null} */
    this.own = null;
    /** @type {Graph | null} the surface's graph that `own` borrows from */
    this.lender = null;
  }

  /**
   * Draw onto a canvas, which takes all of the frame. Returns false while the surface has no
   * living context: making one for a small picture would take it from a large one.
   *
   * @param {import("./graph.js").Frame} frame
   * @param {HTMLCanvasElement} canvas
   */
  draw(frame, canvas) {
    const lender = this.surface.graph;
    const context = canvas.getContext("2d", { alpha: false });
    if (!lender || !context || lender.gl.isContextLost()) return false;
    if (lender !== this.lender || !this.own) {
      this.lender = lender;
      this.own = new Graph(lender.gl, lender.description, lender.files);
      this.own.programs = lender.programs;
      this.own.textures = lender.textures;
    }
    const { gl } = lender;
    const [width, height] = frame.size;
    // The surface gives its canvas a size again before it draws.
    if (gl.canvas.width < width) gl.canvas.width = width;
    if (gl.canvas.height < height) gl.canvas.height = height;
    this.own.run(frame);
    if (gl.isContextLost()) return false;
    context.imageSmoothingQuality = "high";
    const bottom = gl.canvas.height - height; // rows count from below
    context.drawImage(gl.canvas, 0, bottom, width, height, 0, 0, canvas.width, canvas.height);
    return true;
  }

  /** Free the targets; the next drawing makes them again. */
  rest() {
    if (this.own && this.lender === this.surface.graph) this.own.deleteTargets();
    this.own = this.lender = null;
  }
}
