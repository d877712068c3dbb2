/** Bars under the toolbar: something to know, and what can be done about it. */

import { button } from "../../ui/button.js";
import { element } from "../../ui/element.js";

/**
 * @typedef {{ text: string, actions?: { label: string, run: () => void }[], onClose?: () => void,
 *   seconds?: number }} Notice `onClose` when it is put away by its cross; `seconds` after which it
 *   goes by itself
 */

const PAUSE_MS = 200;

export class Notices {
  /**
   * @param {HTMLElement} root of the editor
   * @param {() => boolean} busy whether the hand is at work: what comes now would move the picture
   *   under it
   * @param {AbortSignal} signal
   */
  constructor(root, busy, signal) {
    this.root = root;
    this.busy = busy;
    this.node = element("div", { class: "sw-notices", role: "status" });
    /** @type {Map<string, { node?: HTMLElement, timer?: ReturnType<typeof setTimeout> }>} */
    this.shown = new Map();
    signal.addEventListener("abort", () => {
      for (const key of [...this.shown.keys()]) this.hide(key);
    });
  }

  /**
   * Show a notice in place of the one of that key, as soon as the hand rests.
   *
   * @param {string} key
   * @param {Notice} notice
   */
  show(key, notice) {
    this.hide(key);
    if (this.busy()) {
      this.shown.set(key, { timer: setTimeout(() => this.show(key, notice), PAUSE_MS) });
      return;
    }
    const { text, actions = [], onClose, seconds } = notice;
    const node = element("div", { class: "sw-notice" }, element("span", {}, text));
    node.classList.toggle("sw-passing", seconds !== undefined);
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
        label: "Dismiss this notice",
        onClick: () => {
          this.hide(key);
          onClose?.();
        },
      }),
    );
    const timer = seconds ? setTimeout(() => this.hide(key), 1000 * seconds) : undefined;
    this.shown.set(key, { node, timer });
    this.node.append(node);
  }

  /** @param {string} key */
  has(key) {
    return this.shown.has(key);
  }

  /** @param {string} key */
  hide(key) {
    const shown = this.shown.get(key);
    clearTimeout(shown?.timer);
    this.shown.delete(key);
    if (!shown?.node) return;
    const focused = shown.node.matches(":focus-within");
    shown.node.remove();
    // The keys stay in the editor.
    if (focused) /** @type {HTMLElement | null} */ (this.root.querySelector(".sw-sun"))?.focus();
  }
}
