/**
 * Starts a widget in a page that holds all of it: the front end and the state lie in the page as
 * text (`sunwidget/widgets/page/html.py`), and no kernel stands behind. The page's still picture stays
 * where the widget cannot run.
 */

import { errorText } from "../host/error_text.js";
import { StandaloneModel, stateOf } from "./model.js";

/** @param {string} id */
const part = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

/** What this browser lacks, as a sentence; "" when nothing. */
function missing() {
  if (document.createElement("canvas").getContext("webgl2")) return "";
  return "This browser has no WebGL2. Turn on hardware acceleration to move the sun here.";
}

async function start() {
  const lack = missing();
  if (lack) throw new Error(lack);
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

/** In a frame of another page, which gives it the height that it asks for. */
function tellHeight() {
  if (window === window.parent) return;
  // The window is as high as what it holds, which so must not follow its height.
  document.documentElement.classList.add("sw-framed");
  const tell = () => {
    const { height } = document.body.getBoundingClientRect();
    window.parent.postMessage({ sunwidgetHeight: height }, "*");
  };
  new ResizeObserver(tell).observe(document.body);
  window.addEventListener("message", tell);
}

tellHeight();
start().catch((error) => {
  const problem = part("problem");
  problem.textContent = errorText(error);
  problem.hidden = false;
  part("notes").hidden = true; // they tell what could be done
});
