/**
 * Starts a widget in a stand-alone page, which holds the front end and the state as text
 * (`sunwidget/widgets/page/html.py`) and has no kernel. If the widget cannot run, the page's still
 * picture stays.
 */

import { errorText } from "../host/error_text.js";
import { StandaloneModel, stateOf } from "./model.js";

/** @param {string} id */
const part = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

/** Return what this browser lacks, as a sentence, or "". */
function describeMissing() {
  if (document.createElement("canvas").getContext("webgl2")) return "";
  return "This browser has no WebGL2. Turn on hardware acceleration to move the sun here.";
}

async function start() {
  const missing = describeMissing();
  if (missing) throw new Error(missing);
  const state = stateOf(JSON.parse(part("content").textContent ?? ""));
  const url = URL.createObjectURL(
    new Blob([/** @type {string} */ (state._esm)], { type: "text/javascript" }),
  );
  const { default: widget } = await import(url);
  URL.revokeObjectURL(url);
  delete state._esm;
  const host = part("widget");
  await widget.render({ model: new StandaloneModel(state), el: host });
  part("still").hidden = true;
}

/** In a frame of another page, report the height that this page needs. */
function reportHeight() {
  if (window === window.parent) return;
  // The window's height follows its content, so the content must not follow the window's height.
  document.documentElement.classList.add("sw-framed");
  const report = () => {
    const { height } = document.body.getBoundingClientRect();
    window.parent.postMessage({ sunwidgetHeight: height }, "*");
  };
  new ResizeObserver(report).observe(document.body);
  window.addEventListener("message", report);
}

reportHeight();
start().catch((error) => {
  const problem = part("problem");
  problem.textContent = errorText(error);
  problem.hidden = false;
  part("notes").hidden = true; // they describe what the widget can do
});
