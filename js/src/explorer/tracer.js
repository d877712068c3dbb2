/** The path-traced reference: a drawing adds a path to each pixel, so it draws on by itself. */

import { Fence } from "../gl/fence.js";
import { MOST_SAMPLES } from "./limits.js";

const LOOK_MS = 5;

export class Tracer {
  /**
   * @param {import("./view.js").View} view
   * @param {AbortSignal} signal
   */
  constructor(view, signal) {
    this.view = view;
    this.paused = false;
    this.fence = new Fence(view.frame);
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    signal.addEventListener("abort", () => clearTimeout(this.timer));
  }

  /** Whether the picture is not done yet. */
  get works() {
    const { model, compare } = this.view.state.values;
    const used = model === "reference" || compare === "reference";
    return used && !this.paused && this.view.frame.samples < MOST_SAMPLES;
  }

  /**
   * Draw the next path once this one is done: a slow machine would else gather frames in a queue,
   * and everything else would wait behind it.
   */
  goOn() {
    clearTimeout(this.timer);
    const look = () => {
      if (!this.fence.passed()) this.timer = setTimeout(look, LOOK_MS);
      else if (this.works) this.view.requestFrame();
    };
    look();
  }
}
