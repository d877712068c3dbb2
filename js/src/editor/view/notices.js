/** Notice bars under the toolbar, with actions. */

import { button } from "../../ui/button.js";
import { element } from "../../ui/element.js";

/**
 * @typedef {{ text: string, actions?: { label: string, run: () => void }[], onClose?: () => void,
 *   seconds?: number }} Notice `onClose` is called when the user dismisses it; it
 *   disappears after `seconds`
 */

const PAUSE_MS = 200;

export class Notices {
  /**
   * @param {HTMLElement} root of the editor
   * @param {() => boolean} busy whether a gesture is in progress: a new notice would move the
   *   picture under it
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
   * Show a notice in place of the one with that key, once no gesture is in progress.
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
    // Keep the focus, and so the keys, in the editor.
    if (focused) /** @type {HTMLElement | null} */ (this.root.querySelector(".sw-sun"))?.focus();
  }
}
