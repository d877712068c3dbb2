/**
 * The panel: presets, a filter, and sliders by section, built from the kernel's parameter table.
 * Few sections are open; each shows how many of its values have changed. Sections other than
 * sliders are separate parts (`parts.js`).
 */

import { equal } from "../../edit/equality.js";
import { choice } from "../../ui/choice.js";
import { element } from "../../ui/element.js";
import { countedSection, section } from "../../ui/section.js";
import { slider } from "../../ui/slider.js";
import { panelFilter } from "./panel_filter.js";
import { Softness } from "./softness.js";

/**
 * @typedef {import("../../host/types.js").Parameter} Parameter
 * @typedef {ReturnType<typeof panel>} Panel
 * @typedef {import("../types.js").Needs<"inspector" | "model" | "picture" | "state">} Needs
 * @typedef {import("./panel_filter.js").Row} Row
 * @typedef {import("./panel_filter.js").Section} Section
 */

const OPEN = ["sun", "histogram"];

/**
 * Which sections are open, by model: a further view of the editor starts like the last one.
 *
 * @type {WeakMap<object, Record<string, boolean>>}
 */
const folds = new WeakMap();

/** @param {string} name */
const title = (name) => name[0].toUpperCase() + name.slice(1);

/** @param {Needs} needs */
export function panel({ inspector, model, picture, state }) {
  const open = { ...folds.get(model) };
  /** Whether a section is open when nothing is filtered. @param {string} name */
  const isOpen = (name) => open[name] ?? OPEN.includes(name);
  /** @param {string} name @param {boolean} on */
  const keepFold = (name, on) => {
    open[name] = on;
    folds.set(model, { ...open });
  };
  const ramp = inspector.maps.find((map) => map.name === "cloud_softness")?.ramp;
  const softness = new Softness({ picture, state }, ramp);

  /** @param {Parameter} p */
  const isChanged = (p) => !equal(state.values[p.name], p.default);

  /** @param {string} name @param {Parameter[]} parameters @returns {Section} */
  const makeSection = (name, parameters) => {
    const rows = parameters.map((p) => makeRow({ picture, state }, p));
    // Parameters that need the kernel are set once, not explored.
    const folded = rows.filter(({ parameter: p }) => p.advanced || p.analysis);
    const all = folded.length === rows.length;
    const main = element("div", { class: "sw-section-main" });
    main.append(...rows.filter((row) => all || !folded.includes(row)).map(({ node }) => node));
    /** @type {HTMLDetailsElement | null} */
    let more = null;
    const inMore = element("span", { class: "sw-more-changed" });
    if (folded.length && !all) {
      const nodes = /** @type {Node[]} */ (folded.map(({ node }) => node));
      if (name === "clouds") nodes.splice(1, 0, softness.node);
      more = section({ title: "More", open: false, className: "sw-more" }, ...nodes);
      more.querySelector("summary")?.append(inMore);
    }
    const made = countedSection(
      {
        title: title(name),
        open: isOpen(name),
        onFold: (on) => {
          if (!filter.active()) keepFold(name, on);
        },
        onReset: () => state.set(Object.fromEntries(parameters.map((p) => [p.name, p.default]))),
      },
      main,
      ...(more ? [more] : []),
    );
    made.node.dataset.section = name;
    return { ...made, name, rows, main, more, inMore };
  };

  const shown = state.parameters.filter((p) => p.kind !== "data");
  const names = [...new Set(shown.map((p) => p.section))];
  const sections = names.map((name) =>
    makeSection(
      name,
      shown.filter((p) => p.section === name),
    ),
  );
  const filter = panelFilter(state, sections, { isChanged, isOpen });
  const top = element("div", { class: "sw-panel-top" });
  const node = element(
    "div",
    { class: "sw-panel", role: "group", "aria-label": "Parameters" },
    top,
    filter.node,
    ...sections.map((made) => made.node),
    filter.none,
  );
  return {
    node,
    /** Focus the filter. */
    find: filter.focus,
    /** Above the sections: presets, histogram. */
    top,
    isOpen,
    keepFold,
    /** The node where a part adds its rows: below the section's own, above "More". @param {string} name */
    section(name) {
      const found = sections.find((made) => made.name === name);
      if (!found) throw new Error(`The panel has no section "${name}".`);
      return found.main;
    },
    show() {
      softness.show();
      for (const { rows, setChanged, more, inMore } of sections) {
        for (const row of rows) row.show();
        const changed = rows.filter(({ parameter }) => isChanged(parameter));
        setChanged(changed.map(({ parameter }) => parameter.label));
        const within = changed.filter(({ node: row }) => more?.contains(row)).length;
        const text = within ? `· ${within} changed` : "";
        if (inMore.textContent !== text) inMore.textContent = text;
      }
      filter.show();
    },
  };
}

/** Make the control of one parameter. @param {Pick<Needs, "picture" | "state">} needs @param {Parameter} p @returns {Row} */
function makeRow({ picture, state }, p) {
  if (p.kind === "choice") {
    const control = choice({ parameter: p, onChange: (value) => state.set({ [p.name]: value }) });
    const show = () => control.show(String(state.values[p.name] ?? p.default));
    return { parameter: p, node: control.node, show };
  }
  const control = slider({
    parameter: p,
    onBegin: () => state.begin(),
    onInput: (value) => state.set({ [p.name]: value }),
    onCommit: () => state.commit(),
  });
  const show = () => {
    const value = /** @type {number | null} */ (state.values[p.name]);
    control.show(value, picture.scene?.automatic[p.name]);
  };
  return { parameter: p, node: control.node, show };
}
