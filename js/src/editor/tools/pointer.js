/** Pointers on the editor's stage: one drags with the chosen tool, or hovers. */

import { listenToPointers } from "../../ui/pointers.js";

/**
 * @param {import("../view/view.js").View} view
 * @param {AbortSignal} signal
 * @returns {() => void} drops what a pointer has begun, and lets it go
 */
export function listenToPointer(view, signal) {
  const { stage } = view;
  const tool = () => view.tools[view.tool];
  const cancel = listenToPointers(
    stage,
    {
      tool,
      ready: () => view.scene !== null,
      zoom: stage.zoom,
      onTake(pointer) {
        view.pointer = pointer;
        if (pointer !== null) stage.focus();
      },
      onPoint(place, free) {
        view.point(place);
        if (free) tool().hover?.(place);
      },
    },
    signal,
  );
  stage.overlay.addEventListener("dblclick", () => tool().reset?.(), { signal });
  // The focus is where a pointer or the tool has put it.
  stage.overlay.addEventListener("mousedown", (event) => event.preventDefault(), { signal });
  return cancel;
}
