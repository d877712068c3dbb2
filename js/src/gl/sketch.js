/**
 * Draws other edits of a surface's picture in small.
 *
 * They use the surface's context, pictures and compiled shaders, but their own targets, so that the
 * surface's drawn passes stay valid and its next frame costs no more.
 */

import { Graph } from "./graph.js";
import { same } from "./targets.js";

/**
 * @typedef {import("./graph.js").Frame} Frame
 * @typedef {import("./surface.js").Surface} Surface
 * @typedef {import("./target.js").Target} Target
 */

/** A graph that reuses another's drawn passes where it would draw the same. */
class Borrower extends Graph {
  /** @param {Graph} lender */
  constructor(lender) {
    super(lender.gl, lender.description, lender.programs.files);
    this.lender = lender;
    this.programs = lender.programs;
    this.textures = lender.textures;
    /** @type {Map<string, Target>} of the current run: the lender may draw between runs */
    this.lent = new Map();
    // The lender counts in whole numbers, so versions never collide.
    this.versions = 0.5;
  }

  /**
   * @param {Frame} frame
   * @param {string} [until]
   */
  run(frame, until) {
    this.lent.clear();
    super.run(frame, until);
  }

  /**
   * @param {import("./graph.js").Pass} pass
   * @param {[number, number]} size
   * @param {(number | string)[]} key
   * @param {number} frame
   */
  target(pass, size, key, frame) {
    const lent = this.lender.targets.latest.get(pass.name);
    const { width, height } = lent?.texture ?? {};
    if (lent?.key && width === size[0] && height === size[1] && same(lent.key, key)) {
      this.lent.set(pass.name, lent);
      return lent;
    }
    return super.target(pass, size, key, frame);
  }

  /**
   * Draw a pass with parts at once: the canvas's only depth buffer belongs to the lender.
   *
   * @param {import("./graph.js").Pass} pass
   */
  stages(pass) {
    return super.stages(pass).slice(-1);
  }

  /**
   * @param {import("./graph.js").Pass} pass
   * @param {string} name
   */
  input(pass, name) {
    return this.lent.get(name)?.texture ?? super.input(pass, name);
  }
}

export class Sketch {
  /** @param {Surface} surface */
  constructor(surface) {
    this.surface = surface;
    /** @type {Borrower | null} */
    this.graph = null;
  }

  /**
   * Draw the whole frame onto a canvas. Returns false while the surface has no live context: making
   * one for a small picture would take it from a large one.
   *
   * @param {Frame} frame
   * @param {HTMLCanvasElement} canvas
   */
  draw(frame, canvas) {
    const lender = this.surface.graph;
    const context = canvas.getContext("2d", { alpha: false });
    if (!lender || !context || lender.gl.isContextLost()) return false;
    if (this.graph?.lender !== lender) this.graph = new Borrower(lender);
    const { gl } = lender;
    const [width, height] = frame.size;
    // The surface resizes its canvas again before it draws.
    if (gl.canvas.width < width || gl.canvas.height < height) {
      gl.canvas.width = Math.max(gl.canvas.width, width);
      gl.canvas.height = Math.max(gl.canvas.height, height);
      lender.partsKey = [];
    }
    this.graph.run(frame);
    if (gl.isContextLost()) return false;
    context.imageSmoothingQuality = "high";
    const bottom = gl.canvas.height - height; // rows count from below
    context.drawImage(gl.canvas, 0, bottom, width, height, 0, 0, canvas.width, canvas.height);
    return true;
  }

  /** Free the targets; the next drawing makes them again. */
  freeTargets() {
    if (this.graph && this.graph.lender === this.surface.graph) this.graph.targets.dispose();
    this.graph = null;
  }
}
