/** What the editor says aloud: the tool, the sun's place, strokes, before and after, the analysis. */

/**
 * What can be said, by what it is about.
 *
 * @param {import("../types.js").Needs<"foot" | "hand" | "model" | "root" | "strokes"
 *   | "toolbar">} needs
 * @returns {Record<string, string>}
 */
function texts({ foot, hand, model, root, strokes, toolbar }) {
  const tool = toolbar.tools.find(({ value }) => value === hand.tool);
  const count = strokes.strokes().length;
  return {
    tool: tool?.node.getAttribute("aria-label") ?? "",
    before: root.classList.contains("sw-before") ? "Before: the photo" : "After: the edit",
    sun: foot.readout.textContent ?? "",
    strokes: count === 1 ? "1 stroke" : `${count} strokes`,
    analysis: model.get("_status")?.stage === "ready" ? "The analysis is done" : "",
  };
}

/** What tells of itself while it has the focus. @type {Record<string, string>} */
const TELLS = { tool: '[role="radio"]', before: "[aria-pressed]", sun: ".sw-sun, input" };

/**
 * @type {import("../types.js").MakePart<"announcer" | "foot" | "hand" | "model" | "root"
 *   | "strokes" | "toolbar">}
 */
export function announcements({ announcer, ...needs }, signal) {
  const { model, root } = needs;
  /** @type {Record<string, string> | null} what stands there at first is read when one comes to it */
  let known = null;
  const look = () => {
    const { activeElement } = /** @type {Document | ShadowRoot} */ (root.getRootNode());
    const now = texts(needs);
    for (const [about, text] of Object.entries(known ? now : {})) {
      if (!text || text === known?.[about]) continue;
      if (!(about in TELLS && activeElement?.matches(TELLS[about]))) announcer.say(text, about);
    }
    known = now;
  };
  model.on("change:_status", look);
  signal.addEventListener("abort", () => model.off("change:_status", look));
  return { draw: look, loaded: look };
}
