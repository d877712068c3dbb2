/**
 * Disables controls that need the kernel while none answers, and gives the reason as their title:
 * permanently in a stand-alone page, in a notebook until the kernel is back. Drawing stays live.
 */

/** @typedef {"none" | "lost"} Absence */

/** @type {Record<Absence, string>} */
const REASONS = {
  none: "Needs a kernel: open the photo in a notebook",
  lost: "Needs the kernel: run the cell again",
};

/**
 * @type {import("../types.js").MakePart<"hand" | "inspector" | "kernel" | "panel" | "root"
 *   | "state" | "toolbar">}
 */
export function kernelRequired({ hand, inspector, kernel, panel, root, state, toolbar }) {
  const corrections = state.parameters.filter((p) => p.analysis).map((p) => p.name);
  /** @type {Map<HTMLElement, string>} original titles */
  const titles = new Map();

  /** Controls that ask the kernel. @returns {HTMLElement[]} */
  const controls = () => [
    ...toolbar.tools.filter(({ value }) => value !== "sun").map(({ node }) => node),
    inspector.choice,
    ...corrections.flatMap((name) => inputs(panel.node, `[data-parameter="${name}"]`)),
    ...inputs(panel.node, ".sw-softness"),
  ];

  /** @param {HTMLElement} node @param {string} reason "" when the kernel answers */
  const mark = (node, reason) => {
    if (reason && !titles.has(node)) titles.set(node, node.title);
    if (!reason && !titles.has(node)) return;
    node.title = reason || (titles.get(node) ?? "");
    node.toggleAttribute("disabled", reason !== "");
    if (!reason) titles.delete(node);
  };

  return {
    show() {
      const reason = kernel.state === "live" ? "" : REASONS[kernel.state];
      root.dataset.kernel = kernel.state;
      if (!reason && !titles.size) return;
      for (const node of controls()) mark(node, reason);
      if (reason && hand.tool !== "sun") hand.setTool("sun");
      if (reason && inspector.map) inspector.choose("");
      toolbar.save.title = reason
        ? "Download the picture at preview size"
        : "Render at full size and download";
    },
  };
}

/** @param {HTMLElement} node @param {string} row */
const inputs = (node, row) =>
  /** @type {HTMLElement[]} */ ([...node.querySelectorAll(`${row} :is(input, select, button)`)]);
