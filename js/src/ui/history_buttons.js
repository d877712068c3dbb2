/** The undo, redo and reset buttons. */

import { stepName } from "../edit/step_names.js";
import { button } from "./button.js";
import { element } from "./element.js";

/** @typedef {import("../host/types.js").Edit} Edit */

/**
 * @param {import("../edit/state.js").EditState} state
 * @param {string} resets title of Reset
 * @param {() => import("./chips.js").Preset[]} [presets] presets that name steps
 */
export function historyButtons(state, resets, presets = () => []) {
  const undo = button({
    icon: "undo",
    label: "Undo",
    title: "Undo (Ctrl+Z)",
    onClick: () => state.undo(),
  });
  const redo = button({
    icon: "redo",
    label: "Redo",
    title: "Redo (Ctrl+Shift+Z)",
    onClick: () => state.redo(),
  });
  const reset = button({
    icon: "reset",
    label: "Reset",
    title: resets,
    onClick: () => state.reset(),
  });
  return {
    node: element("div", { class: "sw-group" }, undo, redo, reset),
    show() {
      const { past, future } = state.history();
      undo.disabled = past.length === 0;
      redo.disabled = future.length === 0;
      const recipe = state.recipe();
      reset.disabled = Object.keys(recipe).length === 0;
      if (state.before) return; // do not update titles during a gesture
      const known = {
        parameters: state.parameters,
        versions: state.versions(),
        presets: presets(),
      };
      /** @type {(word: string, from?: Edit, to?: Edit) => string} */
      const title = (word, from, to) =>
        from && to ? `${word}: ${stepName(from, to, known)}` : word;
      undo.title = `${title("Undo", past.at(-1), recipe)} (Ctrl+Z)`;
      redo.title = `${title("Redo", recipe, future[0])} (Ctrl+Shift+Z)`;
    },
  };
}
