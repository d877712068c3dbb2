/**
 * The base of all widgets' stages: the picture in the middle, handles above, room around it for a
 * sun outside the picture, and the progress line at the bottom.
 *
 * Places on the picture are fractions of its width and height, (0, 0) at the top left corner, and may
 * lie outside 0–1. The overlay covers the whole stage, in CSS pixels.
 */

import { element, shape } from "./element.js";

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{ clientX: number, clientY: number }} Spot where a pointer is
 * @typedef {{ x: number, y: number, width: number, height: number, stageWidth: number,
 *   stageHeight: number }} Box the picture in the overlay, and the overlay, in CSS pixels
 */

export class PictureStage {
  /**
   * @param {HTMLElement} picture
   * @param {{ content?: HTMLElement, className?: string, signal: AbortSignal }} options `content`
   *   holds the picture; default the picture itself
   */
  constructor(picture, { content = picture, className = "", signal }) {
    this.picture = picture;
    this.overlay = shape("svg", { class: "sw-overlay" });
    this.bar = element("div", { class: "sw-progress-bar" });
    this.caption = element("span", { class: "sw-progress-text", role: "status" });
    this.progress = element("div", { class: "sw-progress" }, this.bar, this.caption);
    this.node = element(
      "div",
      { class: `sw-stage ${className}`.trim() },
      content,
      this.overlay,
      this.progress,
    );
    /** @type {() => void} called when the layout changed */
    this.onLayout = () => {};
    const observer = new ResizeObserver(() => this.resized());
    observer.observe(this.node);
    observer.observe(picture);
    signal.addEventListener("abort", () => observer.disconnect());
  }

  /** Update after the stage or the picture was resized. */
  resized() {
    this.onLayout();
  }

  /** The picture's rectangle in the overlay. @returns {Box} */
  rectangle() {
    const outer = this.node.getBoundingClientRect();
    const inner = this.picture.getBoundingClientRect();
    return {
      x: inner.left - outer.left,
      y: inner.top - outer.top,
      width: inner.width,
      height: inner.height,
      stageWidth: outer.width,
      stageHeight: outer.height,
    };
  }

  /** Return a pointer's place on the picture. @param {Spot} spot @returns {Point} */
  placeOf({ clientX, clientY }) {
    const box = this.picture.getBoundingClientRect();
    return [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
  }

  /** Return a pointer's point on the overlay. @param {Spot} spot @returns {Point} */
  pointOf({ clientX, clientY }) {
    const { left, top } = this.node.getBoundingClientRect();
    return [clientX - left, clientY - top];
  }

  /** Return the overlay's point at a place of the picture. @param {Point} place @returns {Point} */
  onOverlay([x, y]) {
    const box = this.rectangle();
    return [box.x + x * box.width, box.y + y * box.height];
  }

  /**
   * Show the progress line at the bottom of the stage; `null` hides it.
   *
   * @param {number | null} fraction
   * @param {string} message
   */
  setProgress(fraction, message) {
    this.progress.classList.toggle("sw-shown", fraction !== null);
    if (fraction === null) return;
    this.bar.style.transform = `scaleX(${fraction})`;
    if (this.caption.textContent !== message) this.caption.textContent = message;
  }
}
