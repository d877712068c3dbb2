/** The pointer on the stage: it drags with the chosen tool, pans, and hovers. */

/** @typedef {import("./view.js").View} View */

/**
 * @param {View} view
 * @param {AbortSignal} signal
 */
export function listenToPointer(view, signal) {
  const { overlay } = view.stage;
  let panning = false;
  const tool = () => view.tools[view.tool];
  /** @param {PointerEvent} event */
  const down = (event) => {
    if (view.pointer !== null || !view.scene || event.button > 1) return;
    view.pointer = event.pointerId;
    panning = event.button === 1;
    overlay.setPointerCapture(view.pointer);
    event.preventDefault();
    if (!panning) tool().begin(view.stage.placeOf(event), event);
  };
  /** @param {PointerEvent} event */
  const move = (event) => {
    const place = view.stage.placeOf(event);
    view.inspector.point(place);
    if (view.pointer === null) tool().hover?.(place);
    else if (event.pointerId !== view.pointer) return;
    else if (panning) view.stage.pan(event.movementX, event.movementY);
    else if (tool().fine) {
      const passed = event.getCoalescedEvents?.() ?? [];
      for (const each of passed.length ? passed : [event]) {
        tool().move(view.stage.placeOf(each), each);
      }
    } else tool().move(place, event);
  };
  // The end of capture is the one end of a drag, whatever ended it.
  /** @param {PointerEvent} event */
  const lost = (event) => {
    if (event.pointerId !== view.pointer) return;
    view.pointer = null;
    if (!panning) tool().end();
  };
  const leave = () => {
    view.inspector.point(null);
    if (view.pointer === null) tool().hover?.(null);
  };
  overlay.addEventListener("pointerdown", down, { signal });
  overlay.addEventListener("pointermove", move, { signal });
  overlay.addEventListener("lostpointercapture", lost, { signal });
  overlay.addEventListener("pointerleave", leave, { signal });
  overlay.addEventListener("pointercancel", () => tool().cancel(), { signal });
  overlay.addEventListener("dblclick", () => tool().reset?.(), { signal });
}
