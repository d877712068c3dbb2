/** Keys of the whole editor; the sun's arrow keys belong to its handle. */

const TOOLS = ["sun", "horizon", "pick", "sky", "not_sky"];

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
  else if (key === "b") view.toolbar.before.show(!view.toolbar.before.isOn());
  else if (key === "escape") {
    view.cancelGesture();
    view.setTool("sun");
  } else return;
  event.preventDefault();
  event.stopPropagation();
}
