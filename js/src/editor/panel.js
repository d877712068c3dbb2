/** The sliders, drawn from the kernel's parameter table. */

import { presetChips } from "../controls/chips.js";
import { choice } from "../controls/choice.js";
import { element } from "../controls/element.js";
import { section } from "../controls/section.js";
import { slider } from "../controls/slider.js";
import { Softness } from "./softness.js";

/** @param {string} name */
const title = (name) => name[0].toUpperCase() + name.slice(1);

/**
 * @param {import("./view.js").View} view
 * @returns {{ node: HTMLElement, show: () => void, section: (name: string) => HTMLElement }}
 */
export function panel(view) {
  const { state } = view;
  const node = element("div", { class: "sw-panel", role: "group", "aria-label": "Parameters" });
  /** @type {(() => void)[]} */
  const updates = [];

  /** @param {import("../types.js").Parameter} p */
  const row = (p) => {
    if (p.kind === "choice") {
      const control = choice({
        parameter: p,
        onChange: (value) => state.set({ [p.name]: value }),
      });
      updates.push(() => control.show(String(state.values[p.name] ?? p.default)));
      return control.node;
    }
    const control = slider({
      parameter: p,
      onBegin: () => state.begin(),
      onInput: (value) => state.set({ [p.name]: value }),
      onCommit: () => state.commit(),
    });
    updates.push(() => {
      const value = /** @type {number | null} */ (state.values[p.name]);
      control.show(value, view.scene?.automatic[p.name]);
    });
    return control.node;
  };

  const presets = presetChips(state, () => view.scene?.presets ?? []);
  node.append(presets.node);
  updates.push(presets.show);
  const softness = new Softness(view);
  updates.push(() => softness.show());
  /** @type {Map<string, HTMLElement>} */
  const sections = new Map();
  const shown = view.parameters.filter((p) => p.kind !== "data");
  for (const name of new Set(shown.map((p) => p.section))) {
    const rows = shown.filter((p) => p.section === name);
    // What the kernel has to answer is set once, not played with.
    const folded = (/** @type {import("../types.js").Parameter} */ p) => p.advanced || p.analysis;
    const main = rows.filter((p) => !folded(p));
    const more = rows.filter(folded);
    const body = /** @type {Node[]} */ (main.map(row));
    if (main.length && more.length) {
      const nodes = /** @type {Node[]} */ (more.map(row));
      if (name === "clouds") nodes.splice(1, 0, softness.node);
      body.push(section({ title: "More", open: false, className: "sw-more" }, ...nodes));
    }
    const made = main.length
      ? section({ title: title(name) }, ...body)
      : section({ title: title(name), open: false }, ...more.map(row));
    node.append(made);
    sections.set(name, /** @type {HTMLElement} */ (made.querySelector(".sw-section-body")));
  }
  return {
    node,
    /** Where a part may add its rows. */
    section(name) {
      const body = sections.get(name);
      if (!body) throw new Error(`The panel has no section "${name}".`);
      return body;
    },
    show: () => {
      for (const update of updates) update();
    },
  };
}
