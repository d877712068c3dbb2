/** The anywidget module of SunEditor. */

import { Frame } from "../frame.js";
import { Sketch } from "../gl/sketch.js";
import { keepKeys } from "../host_keys.js";
import { View } from "./view.js";

// Nothing slow belongs here: `initialize` must settle within two seconds.
/** @param {{ model: import("../types.js").Model, el: HTMLElement }} context */
function render({ model, el }) {
  const controller = new AbortController();
  const root = document.createElement("div");
  root.className = "sunwidget";
  keepKeys(root, controller.signal);
  root.setAttribute("role", "group");
  root.setAttribute("aria-label", "Sun editor");
  el.append(root);
  try {
    new View(model, root, controller.signal);
  } catch (error) {
    root.textContent = `SunEditor cannot start: ${error instanceof Error ? error.message : error}`;
  }
  return () => {
    controller.abort();
    root.remove();
  };
}

export default { render };
// For tests and for pages without a kernel.
export { Frame, Sketch };
