/**
 * What the stages of both widgets share: the picture in the middle, handles above, room around it
 * for a sun outside the picture, and the progress line at the foot.
 */

import { element, shape } from "./element.js";

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {{ x: number, y: number, width: number, height: number, stageWidth: number,
 *   stageHeight: number }} Box the picture in the overlay, and the overlay, in CSS pixels
 */

export class PictureStage {
  /**
   * @param {HTMLElement} picture
   * @param {{ content?: HTMLElement, className?: string, signal: AbortSignal }} options `content`
   *   holds the picture where it is not the picture itself
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

  /** The stage or the picture has another size. */
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

  /**
   * The line at the foot of the stage: `null` hides it.
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
