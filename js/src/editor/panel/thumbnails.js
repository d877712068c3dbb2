/**
 * Thumbnails of other edits of the photo. They are drawn one by one while the page is idle and they
 * are visible, never during a drag.
 */

import { Fence } from "../../gl/fence.js";
import { Sketch } from "../../gl/sketch.js";
import { whenIdle } from "../../host/idle.js";

const AREA = 76_000; // pixels of a frame; nine are averaged to one of the thumbnail
const SHRINK = 3;
const DENSE = 2; // device pixels per CSS pixel that the thumbnails are made for
const QUIET_MS = 400; // after the last change
const PAUSE_MS = 60; // between two thumbnails
const WIDTH = 150; // of the photo shown in place of a thumbnail, pixels

/**
 * @typedef {{ canvas: HTMLCanvasElement, edit: import("../../host/types.js").Edit, key: string }} Wanted
 *   `key` identifies what it shows; a new key redraws it
 */

export class Thumbnails {
  /**
   * @param {import("../types.js").Needs<"drawing" | "hand" | "picture" | "stage" | "state">} needs
   * @param {AbortSignal} signal
   */
  constructor({ drawing, hand, picture, stage, state }, signal) {
    this.drawing = drawing;
    this.hand = hand;
    this.picture = picture;
    this.photo = stage.photo;
    this.state = state;
    this.signal = signal;
  }

  /** Show the photo until the thumbnail is drawn. @param {HTMLCanvasElement} canvas */
  placePhoto(canvas) {
    const { photo } = this;
    if (!photo.naturalWidth) return;
    canvas.width = WIDTH;
    canvas.height = Math.round((WIDTH * photo.naturalHeight) / photo.naturalWidth);
    canvas.getContext("2d")?.drawImage(photo, 0, 0, canvas.width, canvas.height);
  }

  /**
   * Draw thumbnails, and redraw those whose key changes.
   *
   * @param {HTMLElement} node thumbnails are drawn while this is visible
   * @param {() => Wanted[]} read returns the current thumbnails
   */
  keep(node, read) {
    const { drawing, hand, picture, signal, state } = this;
    const sketch = new Sketch(drawing.frame);
    const fence = new Fence(drawing.frame);
    /** @type {WeakMap<HTMLCanvasElement, string>} keys that are drawn */
    const drawn = new WeakMap();
    let inSight = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    let timer;
    let forget = () => {};

    const busy = () => drawing.loop.busy || hand.pointer !== null || state.before !== null;

    /** @type {(wait?: number) => void} */
    const wake = (wait = QUIET_MS) => {
      if (signal.aborted) return;
      clearTimeout(timer);
      forget();
      timer = setTimeout(() => {
        if (!picture.scene || !inSight) return;
        forget = whenIdle(draw);
      }, wait);
    };
    const draw = () => {
      if (busy()) return wake();
      const next = read().find(({ canvas, key }) => drawn.get(canvas) !== key);
      if (!next) return sketch.freeTargets();
      // Queue no more than one: the next drag's frames would wait behind them.
      if (!fence.passed()) return wake(PAUSE_MS);
      const [width, height] = picture.size;
      const scale = Math.min(1, Math.sqrt(AREA / (width * height)));
      /** @type {[number, number]} */
      const size = [
        Math.max(1, Math.round(width * scale)),
        Math.max(1, Math.round(height * scale)),
      ];
      const { canvas, edit, key } = next;
      const frame = drawing.frame.describe(edit, size);
      if (!frame) return;
      canvas.width = Math.ceil((size[0] * DENSE) / SHRINK);
      canvas.height = Math.ceil((size[1] * DENSE) / SHRINK);
      // Without a context, wait until the picture is drawn again.
      if (!sketch.draw(frame, canvas)) return;
      drawn.set(canvas, key);
      canvas.classList.add("sw-drawn");
      wake(PAUSE_MS);
    };

    const observer = new IntersectionObserver((entries) => {
      inSight = entries[entries.length - 1].isIntersecting;
      if (inSight) wake();
    });
    observer.observe(node);
    // A crash of the graphics process also clears canvases.
    const onRestored = (/** @type {Event} */ { target }) => {
      drawn.delete(/** @type {HTMLCanvasElement} */ (target));
      wake();
    };
    node.addEventListener("contextrestored", onRestored, { capture: true, signal });
    signal.addEventListener("abort", () => {
      clearTimeout(timer);
      forget();
      observer.disconnect();
      sketch.freeTargets();
    });
    return { wake: () => wake() };
  }
}
