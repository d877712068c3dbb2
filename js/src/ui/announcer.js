/** Announces changes to screen readers that the focused control does not report. */

import { element } from "./element.js";

const QUIET_MS = 500; // a pause before announcing, so that a drag does not flood the reader

export class Announcer {
  /** @param {AbortSignal} signal ends it */
  constructor(signal) {
    this.node = element("div", { class: "sw-spoken", role: "status", "aria-live": "polite" });
    /** @type {Map<string, string>} texts by topic */
    this.waiting = new Map();
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    signal.addEventListener("abort", () => clearTimeout(this.timer));
  }

  /**
   * Announce a text once nothing new has arrived for a while. Of several texts on one topic only the
   * last is announced.
   *
   * @param {string} text
   * @param {string} [about]
   */
  say(text, about = "") {
    this.waiting.delete(about);
    this.waiting.set(about, text);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      // A new child, so that a repeated text is announced again.
      this.node.replaceChildren(element("p", {}, [...this.waiting.values()].join(". ")));
      this.waiting.clear();
    }, QUIET_MS);
  }
}
