/**
 * The loaded analyses: a frame for each set of maps. Recipes share one unless they have their own
 * strokes or hints, so there is usually one.
 */

import { Camera } from "../geometry/camera.js";
import { Frame, MAPS } from "../gl/frame.js";
import { decodePicture } from "../gl/texture.js";
import { element } from "../ui/element.js";

/** @typedef {import("../host/types.js").Scene & { revision: number }} Scene */

export class Scenes {
  /**
   * @param {import("../host/types.js").Model} model
   * @param {number} turns number of pictures that each frame draws in turn
   * @param {AbortSignal} signal frees all
   */
  constructor(model, turns, signal) {
    this.model = model;
    this.turns = turns;
    /** @type {Frame[]} */
    this.frames = [];
    /** @type {Scene[]} */
    this.found = [];
    /** @type {Camera[]} */
    this.cameras = [];
    this.loads = 0;
    signal.addEventListener("abort", () => {
      this.loads += 1;
      for (const frame of this.frames) frame.dispose();
    });
  }

  /**
   * Decode all maps that the kernel sent, then swap all at once.
   *
   * @returns {Promise<[number, number] | null>} the preview's size in pixels; null while there are
   *   no maps, or if newer ones arrived meanwhile
   */
  async load() {
    /** @type {Record<string, any>[]} */
    const rows = this.model.get("_scenes");
    if (!rows?.length) return null;
    this.loads += 1;
    const load = this.loads;
    const photo = this.model.get("_photo");
    const bitmaps = await Promise.all(
      rows.map((row) =>
        Promise.all([photo, ...MAPS.map((name) => row[`_${name}`])].map(decodePicture)),
      ),
    );
    if (load !== this.loads) {
      for (const bitmap of bitmaps.flat()) bitmap.close();
      return null;
    }
    for (const frame of this.frames.slice(rows.length)) frame.dispose();
    this.frames = rows.map(({ scene }, i) => {
      const frame = this.frames[i] ?? new Frame(element("canvas"), this.model.get("_parameters"));
      ["photo", ...MAPS].forEach((name, n) => {
        frame.setPicture(name, bitmaps[i][n]);
      });
      frame.setScene(scene);
      frame.turns = this.turns;
      return frame;
    });
    this.found = rows.map(({ scene }) => scene);
    this.cameras = this.found.map(({ width, height, camera }) => {
      return new Camera(width, height, camera.fov_vertical_deg, camera.pitch, camera.roll);
    });
    return [bitmaps[0][0].width, bitmaps[0][0].height];
  }
}
