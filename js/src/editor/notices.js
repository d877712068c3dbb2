/** Bars under the toolbar: something to know, and what can be done about it. */

import { button } from "../controls/button.js";
import { element } from "../controls/element.js";

/**
 * @typedef {{ text: string, actions?: { label: string, run: () => void }[], onClose?: () => void,
 *   seconds?: number }} Notice `onClose` when it is put away by its cross; `seconds` after which it
 *   goes by itself
 */

export class Notices {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    this.node = element("div", { class: "sw-notices", role: "status" });
    /** @type {Map<string, { node: HTMLElement, timer?: ReturnType<typeof setTimeout> }>} */
    this.shown = new Map();
    signal.addEventListener("abort", () => {
      for (const key of [...this.shown.keys()]) this.hide(key);
    });
  }

  /**
   * Show a notice in place of the one of that key.
   *
   * @param {string} key
   * @param {Notice} notice
   */
  show(key, { text, actions = [], onClose, seconds }) {
    const node = element("div", { class: "sw-notice" }, element("span", {}, text));
    for (const { label, run } of actions) {
      const act = element("button", { type: "button", class: "sw-notice-action" }, label);
      act.addEventListener("click", () => {
        this.hide(key);
        run();
      });
      node.append(act);
    }
    node.append(
      button({
        icon: "close",
        label: "Put this away",
        onClick: () => {
          this.hide(key);
          onClose?.();
        },
      }),
    );
    this.hide(key);
    const timer = seconds ? setTimeout(() => this.hide(key), 1000 * seconds) : undefined;
    this.shown.set(key, { node, timer });
    this.node.append(node);
  }

  /** @param {string} key */
  hide(key) {
    const shown = this.shown.get(key);
    clearTimeout(shown?.timer);
    shown?.node.remove();
    this.shown.delete(key);
  }
}
