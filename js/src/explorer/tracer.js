/** The path-traced reference: each drawing adds a path per pixel, so it keeps drawing. */

import { Fence } from "../gl/fence.js";
import { MOST_SAMPLES } from "./limits.js";

const POLL_MS = 5;

export class Tracer {
  /**
   * @param {import("./types.js").Needs<"frame" | "requestFrame" | "state">} view
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

  /** Whether the picture is still being traced. */
  get works() {
    const { model, compare } = this.view.state.values;
    const used = model === "reference" || compare === "reference";
    return used && !this.paused && this.view.frame.samples < MOST_SAMPLES;
  }

  /**
   * Draw the next path once this one is done: otherwise a slow machine would queue frames, and
   * everything else would wait behind them.
   */
  continue() {
    clearTimeout(this.timer);
    const poll = () => {
      if (!this.fence.passed()) this.timer = setTimeout(poll, POLL_MS);
      else if (this.works) this.view.requestFrame();
    };
    poll();
  }
}
