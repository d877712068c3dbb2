/** What a screen reader says of changes that nothing with the focus tells. */

import { element } from "./element.js";

const QUIET_MS = 500; // only what still holds after a pause is said: a drag would be a torrent

export class Announcer {
  /** @param {AbortSignal} signal ends it */
  constructor(signal) {
    this.node = element("div", { class: "sw-spoken", role: "status", "aria-live": "polite" });
    /** @type {Map<string, string>} by what they are about */
    this.waiting = new Map();
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    signal.addEventListener("abort", () => clearTimeout(this.timer));
  }

  /**
   * Say a text once nothing new has come for a while. Of several texts about one thing the last
   * is said.
   *
   * @param {string} text
   * @param {string} [about]
   */
  say(text, about = "") {
    this.waiting.delete(about);
    this.waiting.set(about, text);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      // A child of its own: the same text said again is new, too.
      this.node.replaceChildren(element("p", {}, [...this.waiting.values()].join(". ")));
      this.waiting.clear();
    }, QUIET_MS);
  }
}
