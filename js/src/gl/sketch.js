/**
 * Other edits of a surface's picture, drawn small beside it.
 *
 * They run on the surface's own context with its pictures and compiled shaders, but with targets
 * of their own: what the surface has drawn stays drawn, so that its next frame costs no more.
 */

import { Graph } from "./graph.js";
import { same } from "./targets.js";

/**
 * @typedef {import("./graph.js").Frame} Frame
 * @typedef {import("./surface.js").Surface} Surface
 * @typedef {import("./target.js").Target} Target
 */

/** A graph that reads what another has drawn, where it would draw just the same. */
class Borrower extends Graph {
  /** @param {Graph} lender */
  constructor(lender) {
    super(lender.gl, lender.description, lender.programs.files);
    this.lender = lender;
    this.programs = lender.programs;
    this.textures = lender.textures;
    /** @type {Map<string, Target>} of the present run: the lender may draw between two */
    this.lent = new Map();
    // The lender counts in whole numbers: a version of one is never one of the other.
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
   * A pass that has parts is drawn in one go: the canvas has one depth, and it is the lender's.
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
   * Draw onto a canvas, which takes all of the frame. Returns false while the surface has no
   * living context: making one for a small picture would take it from a large one.
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
    // The surface gives its canvas a size again before it draws.
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
  rest() {
    if (this.graph && this.graph.lender === this.surface.graph) this.graph.targets.dispose();
    this.graph = null;
  }
}
