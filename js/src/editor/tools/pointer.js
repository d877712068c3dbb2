/** Pointers on the editor's stage: one drags with the chosen tool, or hovers. */

import { listenToPointers } from "../../ui/pointers.js";

/**
 * @param {import("../types.js").Needs<"hand" | "parts" | "picture" | "stage">} needs
 * @param {AbortSignal} signal
 * @returns {() => void} cancels the pointer's gesture and releases it
 */
export function listenToPointer({ hand, parts, picture, stage }, signal) {
  const tool = () => hand.tools[hand.tool];
  const cancel = listenToPointers(
    stage,
    {
      tool,
      ready: () => picture.scene !== null,
      zoom: stage.zoom,
      onTake(pointer) {
        hand.pointer = pointer;
        if (pointer !== null) stage.focus();
      },
      onPoint(place, free) {
        parts.point(place);
        if (free) tool().hover?.(place);
      },
    },
    signal,
  );
  stage.overlay.addEventListener("dblclick", () => tool().reset?.(), { signal });
  // Keep the focus where the pointer or tool has set it.
  stage.overlay.addEventListener("mousedown", (event) => event.preventDefault(), { signal });
  return cancel;
}
