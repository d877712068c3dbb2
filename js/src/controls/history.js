/** Undo, redo and back to the start. */

import { button } from "./button.js";
import { element } from "./element.js";

/** @param {import("../state.js").EditState} state @param {string} resets what Reset does */
export function historyButtons(state, resets) {
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
      reset.disabled = Object.keys(state.recipe()).length === 0;
    },
  };
}
