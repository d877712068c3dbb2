/** What the editor says aloud: the tool, the sun's place, strokes, before and after, the analysis. */

/** @typedef {import("./view.js").View} View */

/**
 * What can be said, by what it is about.
 *
 * @param {View} view
 * @returns {Record<string, string>}
 */
function texts(view) {
  const tool = view.toolbar.tools.find(({ value }) => value === view.hand.tool);
  const strokes = view.strokes.strokes().length;
  return {
    tool: tool?.node.getAttribute("aria-label") ?? "",
    before: view.root.classList.contains("sw-before") ? "Before: the photo" : "After: the edit",
    sun: view.foot.readout.textContent ?? "",
    strokes: strokes === 1 ? "1 stroke" : `${strokes} strokes`,
    analysis: view.model.get("_status")?.stage === "ready" ? "The analysis is done" : "",
  };
}

/** What tells of itself while it has the focus. @type {Record<string, string>} */
const TELLS = { tool: '[role="radio"]', before: "[aria-pressed]", sun: ".sw-sun, input" };

/** @type {import("../parts.js").MakePart} */
export function announcements(view, signal) {
  /** @type {Record<string, string> | null} what stands there at first is read when one comes to it */
  let known = null;
  const look = () => {
    const { activeElement } = /** @type {Document | ShadowRoot} */ (view.root.getRootNode());
    const now = texts(view);
    for (const [about, text] of Object.entries(known ? now : {})) {
      if (!text || text === known?.[about]) continue;
      if (!(about in TELLS && activeElement?.matches(TELLS[about])))
        view.announcer.say(text, about);
    }
    known = now;
  };
  view.model.on("change:_status", look);
  signal.addEventListener("abort", () => view.model.off("change:_status", look));
  return { draw: look, loaded: look };
}
