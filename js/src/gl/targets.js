/**
 * The targets of a graph's passes: each pass's latest, and spares for reuse, since drags draw smaller
 * and several edits are drawn in turn.
 */

import { createTarget, deleteTarget } from "./target.js";

/** @typedef {import("./target.js").Target} Target */

export class Targets {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    /** @type {Map<string, Target>} by pass */
    this.latest = new Map();
    /**
     * Targets at other sizes: after a drag's smaller frames, the full-size results are still there.
     *
     * @type {Map<string, Target[]>}
     */
    this.spares = new Map();
    /** Number of edits drawn in turn, and of targets kept for each table of fixed size. */
    this.turns = 1;
  }

  /**
   * Return the target that a pass draws to, or the one that already holds this result. The result for
   * another frame size stays.
   *
   * @param {import("./graph.js").Pass} pass
   * @param {[number, number]} size
   * @param {(number | string)[]} key what the pass is drawn from
   * @param {number} frame width of the frame
   */
  take({ name, size: asked }, size, key, frame) {
    const table = this.turns > 1 && typeof asked[0] === "number";
    // Most recently used first.
    const all = [this.latest.get(name), this.spares.get(name)].flatMap((t) => t ?? []);
    const fitting = all.filter(({ texture: t }) => t.width === size[0] && t.height === size[1]);
    const target =
      fitting.find((t) => t.key && same(t.key, key)) ??
      (table ? fitting[this.turns - 1] : fitting.find((t) => t.frame === frame)) ??
      createTarget(this.gl, name, ...size);
    target.frame = frame;
    this.latest.set(name, target);
    const others = all.filter((t) => t !== target);
    // Of many sizes keep the full picture: it is the most expensive.
    if (!table) others.sort((a, b) => b.frame - a.frame);
    const kept = table ? this.turns - 1 : 1;
    this.spares.set(name, others.slice(0, kept));
    for (const other of others.slice(kept)) deleteTarget(this.gl, other);
    return target;
  }

  /**
   * Read back a pass's latest texels, RGBA by rows, row 0 at the top.
   *
   * @param {string} name
   */
  read(name) {
    const { gl } = this;
    const target = this.latest.get(name);
    if (!target) throw new Error(`Pass "${name}" was not drawn yet.`);
    const { width, height } = target.texture;
    const texels = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, texels);
    return texels;
  }

  /** Free all targets. */
  dispose() {
    for (const target of [...this.latest.values(), ...[...this.spares.values()].flat()]) {
      deleteTarget(this.gl, target);
    }
    this.latest.clear();
    this.spares.clear();
  }
}

/**
 * Whether two keys of a pass are equal.
 *
 * @param {(number | string)[]} a
 * @param {(number | string)[]} b
 */
export function same(a, b) {
  // Object.is: a NaN must not redraw its pass forever.
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}
