/**
 * Where the sky stands: the canvas in the middle, guides and handles above, room around it to drag
 * the sun below the horizon. Places are CSS pixels from the picture's top left corner.
 */

import { element, shape } from "../controls/element.js";
import { ASPECTS } from "./projection.js";

/** @typedef {import("../types.js").Point} Point */

export class SkyStage {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    this.canvas = element("canvas", {
      class: "sw-sky-canvas",
      role: "img",
      "aria-label": "The computed sky",
    });
    this.picture = element("div", { class: "sw-sky-picture" }, this.canvas);
    this.overlay = shape("svg", { class: "sw-overlay" });
    this.bar = element("div", { class: "sw-progress-bar" });
    this.caption = element("span", { class: "sw-progress-text", role: "status" });
    this.progress = element("div", { class: "sw-progress" }, this.bar, this.caption);
    this.node = element(
      "div",
      { class: "sw-stage sw-sky-stage" },
      this.picture,
      this.overlay,
      this.progress,
    );
    /** @type {() => void} called when the layout changed */
    this.onLayout = () => {};
    const observer = new ResizeObserver(() => this.onLayout());
    observer.observe(this.node);
    observer.observe(this.picture);
    signal.addEventListener("abort", () => observer.disconnect());
  }

  /** @param {string} projection */
  setProjection(projection) {
    this.node.dataset.projection = projection;
    this.picture.style.setProperty("--sw-aspect", String(ASPECTS[projection] ?? 1.5));
  }

  /** The picture's rectangle in the overlay, in CSS pixels. */
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

  /** @param {{ clientX: number, clientY: number }} event @returns {Point} */
  placeOf(event) {
    const box = this.picture.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
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
