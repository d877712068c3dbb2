/** The anywidget module of a widget: its view in an element of the host's, and how it goes. */

import { errorText } from "./error_text.js";
import { keepFocus, keepKeys } from "./host_keys.js";
import { saveLight } from "./saved_state.js";

/** @typedef {import("./types.js").Model} Model */

/**
 * Shaders and pictures belong into `render`, never into `initialize`, which must settle within
 * two seconds or the widget hears of no update any more.
 *
 * @param {string} name of the widget in Python
 * @param {string} label of the region, for those who hear the page
 * @param {string} kind CSS class of its own, beside that of all
 * @param {new (model: Model, root: HTMLElement, signal: AbortSignal) => unknown} View
 * @param {() => Record<string, unknown>} [unseen] what a notebook keeps in place of heavy traits
 *   while there is no view, whose `saveLight` knows better
 */
export const widget = (name, label, kind, View, unseen) => ({
  /** @param {{ model: Model }} context */
  initialize({ model }) {
    if (unseen) saveLight(model, unseen);
  },

  /** @param {{ model: Model, el: HTMLElement }} context */
  render({ model, el }) {
    const controller = new AbortController();
    const root = document.createElement("div");
    root.className = `sunwidget ${kind}`;
    keepKeys(root, controller.signal);
    keepFocus(root, controller.signal);
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", label);
    el.append(root);
    try {
      new View(model, root, controller.signal);
    } catch (error) {
      root.textContent = `${name} cannot start: ${errorText(error)}`;
    }
    return () => {
      controller.abort();
      root.remove();
    };
  },
});
