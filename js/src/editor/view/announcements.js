/** Announces changes to screen readers: tool, sun, strokes, before and after, analysis. */

/**
 * Current announcements by topic.
 *
 * @param {import("../types.js").Needs<"statusBar" | "hand" | "model" | "root" | "strokes"
 *   | "toolbar">} needs
 * @returns {Record<string, string>}
 */
function texts({ statusBar, hand, model, root, strokes, toolbar }) {
  const tool = toolbar.tools.find(({ value }) => value === hand.tool);
  const count = strokes.strokes().length;
  return {
    tool: tool?.node.getAttribute("aria-label") ?? "",
    before: root.classList.contains("sw-before") ? "Before: the photo" : "After: the edit",
    sun: statusBar.readout.textContent ?? "",
    strokes: count === 1 ? "1 stroke" : `${count} strokes`,
    analysis: model.get("_status")?.stage === "ready" ? "The analysis is done" : "",
  };
}

/** Controls that report their own changes while focused, by topic. @type {Record<string, string>} */
const SELF_REPORTING = { tool: '[role="radio"]', before: "[aria-pressed]", sun: ".sw-sun, input" };

/**
 * @type {import("../types.js").MakePart<"announcer" | "statusBar" | "hand" | "model" | "root"
 *   | "strokes" | "toolbar">}
 */
export function announcements({ announcer, ...needs }, signal) {
  const { model, root } = needs;
  /** @type {Record<string, string> | null} the first state is not announced */
  let known = null;
  const update = () => {
    const { activeElement } = /** @type {Document | ShadowRoot} */ (root.getRootNode());
    const now = texts(needs);
    for (const [about, text] of Object.entries(known ? now : {})) {
      if (!text || text === known?.[about]) continue;
      if (!(about in SELF_REPORTING && activeElement?.matches(SELF_REPORTING[about])))
        announcer.say(text, about);
    }
    known = now;
  };
  model.on("change:_status", update);
  signal.addEventListener("abort", () => model.off("change:_status", update));
  return { draw: update, loaded: update };
}
