/**
 * What the passes of a graph draw to: the target each used last, and those that it may take again, since a drag
 * draws smaller and several edits are drawn in turn.
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
     * What passes drew at another size: a drag draws smaller, and what follows it is there already.
     *
     * @type {Map<string, Target[]>}
     */
    this.spares = new Map();
    /** How many edits are drawn in turn: so many are kept of each table that has a size of its own. */
    this.turns = 1;
  }

  /**
   * Where a pass draws, or has drawn just this: what it drew for another size of the frame stays.
   *
   * @param {import("./graph.js").Pass} pass
   * @param {[number, number]} size
   * @param {(number | string)[]} key what the pass is drawn from
   * @param {number} frame width of the frame
   */
  take({ name, size: asked }, size, key, frame) {
    const table = this.turns > 1 && typeof asked[0] === "number";
    // The one that was used last comes first.
    const made = [this.latest.get(name), this.spares.get(name)].flatMap((t) => t ?? []);
    const fitting = made.filter(({ texture: t }) => t.width === size[0] && t.height === size[1]);
    const target =
      fitting.find((t) => t.key && same(t.key, key)) ??
      (table ? fitting[this.turns - 1] : fitting.find((t) => t.frame === frame)) ??
      createTarget(this.gl, name, ...size);
    target.frame = frame;
    this.latest.set(name, target);
    const others = made.filter((t) => t !== target);
    // Of many sizes the picture in full is kept: it is the dearest.
    if (!table) others.sort((a, b) => b.frame - a.frame);
    const kept = table ? this.turns - 1 : 1;
    this.spares.set(name, others.slice(0, kept));
    for (const other of others.slice(kept)) deleteTarget(this.gl, other);
    return target;
  }

  /**
   * What a pass drew last, RGBA by rows, row 0 at the top.
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

  /** Free them. */
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
  // Object.is: a NaN must not draw its pass for ever.
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}
