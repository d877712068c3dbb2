/** Keys of the whole editor; the sun's arrow keys belong to its handle. */

const TOOLS = ["sun", "horizon", "pick", "sky", "not_sky", "erase"];

/**
 * @param {import("./view.js").View} view
 * @param {KeyboardEvent} event
 */
export function onShortcut(view, event) {
  const target = /** @type {HTMLElement} */ (event.target);
  if (target instanceof HTMLInputElement && target.type === "text") return;
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    if (key === "z" && !event.shiftKey) view.state.undo();
    else if (key === "y" || (key === "z" && event.shiftKey)) view.state.redo();
    else if (key === "0") view.stage.setZoom(1);
    else return;
  } else if (key >= "1" && key <= String(TOOLS.length)) view.setTool(TOOLS[Number(key) - 1]);
  else if (key === "[") view.setBrushRadius(view.brushRadius / 1.25);
  else if (key === "]") view.setBrushRadius(view.brushRadius * 1.25);
  else if (key === "w") view.setSubject(view.subject === "sky" ? "water" : "sky");
  else if (key === "b") view.toolbar.before.show(!view.toolbar.before.isOn());
  else if (key === "m") view.inspector.step(event.shiftKey ? -1 : 1);
  else if (key === "escape") {
    const busy = view.pointer !== null;
    view.cancelGesture();
    // One thing at a time: the gesture, the map, the tool.
    if (!busy && view.inspector.map) view.inspector.show("");
    else view.setTool("sun");
  } else return;
  event.preventDefault();
  event.stopPropagation();
}
