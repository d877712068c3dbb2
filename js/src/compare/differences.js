/** Labels each picture with its difference from the first, measured on small copies at rest. */

import { element } from "../ui/element.js";
import { pictureDifference } from "./color_difference.js";

const EDGE = 160; // longer side of a copy, pixels
const REST_MS = 120; // after the last full frame

export class Differences {
  /** @param {import("./types.js").Needs<"model" | "panels" | "shown" | "signal" | "state">} view */
  constructor(view) {
    this.view = view;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    const context = element("canvas").getContext("2d", { willReadFrequently: true, alpha: false });
    if (!context) throw new Error("This browser has no 2-D canvas.");
    this.context = context;
    view.signal.addEventListener("abort", () => clearTimeout(this.timer));
  }

  /** Measure soon, unless the pictures change again. */
  request() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.measure(), REST_MS);
  }

  measure() {
    const { view } = this;
    const on = Boolean(view.model.get("difference"));
    const [first, ...others] = view.shown();
    for (const panel of view.panels) panel.difference.hidden = true;
    if (!on || view.state.before) return;
    const reference = this.copy(first.canvas);
    for (const { canvas, difference } of others) {
      const { mean, high } = pictureDifference(reference, this.copy(canvas));
      difference.hidden = false;
      difference.textContent = `ΔE₀₀ ${mean.toFixed(1)}`;
      difference.title =
        `CIEDE2000 color difference from ${first.variant.label}: ` +
        `mean ${mean.toFixed(2)}, 95 % of the picture below ${high.toFixed(1)}`;
    }
  }

  /** Return the RGBA of a small copy. @param {HTMLCanvasElement} canvas */
  copy(canvas) {
    const scale = Math.min(1, EDGE / Math.max(canvas.width, canvas.height));
    const [width, height] = [canvas.width, canvas.height].map((n) =>
      Math.max(1, Math.round(n * scale)),
    );
    const { context } = this;
    Object.assign(context.canvas, { width, height });
    context.imageSmoothingQuality = "high";
    context.drawImage(canvas, 0, 0, width, height);
    return context.getImageData(0, 0, width, height).data;
  }
}
