/** Makes the anywidget module of a widget: mounts its view in the host's element, and removes it. */

import { errorText } from "./error_text.js";
import { keepFocus, keepKeys } from "./host_keys.js";
import { saveLight } from "./saved_state.js";

/** @typedef {import("./types.js").Model} Model */

/**
 * Shaders and pictures belong in `render`, never in `initialize`, which must finish within two
 * seconds or the widget no longer receives updates.
 *
 * @param {string} name of the widget in Python
 * @param {string} label of the region, for screen readers
 * @param {string} kind the widget's own CSS class
 * @param {new (model: Model, root: HTMLElement, signal: AbortSignal) => unknown} View
 * @param {() => Record<string, unknown>} [savedWithoutView] what a notebook saves in place of heavy
 *   traits while there is no view; a view replaces it with its own `saveLight`
 */
export const widget = (name, label, kind, View, savedWithoutView) => ({
  /** @param {{ model: Model }} context */
  initialize({ model }) {
    if (savedWithoutView) saveLight(model, savedWithoutView);
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
