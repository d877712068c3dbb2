/** Chips: small buttons in a row, each of which sets some parameters. */

import { equal } from "../edit/equality.js";
import { element } from "./element.js";

/** @typedef {import("../host/types.js").Preset} Preset */

/** @type {(label: string, title: string, onClick: () => void) => HTMLButtonElement} */
export function chip(label, title, onClick) {
  const node = element("button", { type: "button", class: "sw-chip", title }, label);
  node.addEventListener("click", onClick);
  return node;
}

/**
 * One chip per preset: a click is one history step, and a chip is pressed while all its values are
 * set. Parameters that the state lacks are ignored.
 *
 * @param {import("../edit/state.js").EditState} state
 * @param {() => Preset[]} read returns the current presets
 * @param {(preset: Preset) => Node | string} [lead] content before a chip's label
 */
export function presetChips(state, read, lead = () => "") {
  const node = element("div", {
    class: "sw-chips sw-presets",
    role: "group",
    "aria-label": "Presets",
  });
  let drawn = "";
  return {
    node,
    show() {
      const presets = read().map(({ label, title, values }) => {
        const known = Object.entries(values).filter(([name]) => name in state.values);
        return { label, title, values: Object.fromEntries(known) };
      });
      const text = JSON.stringify(presets);
      if (text !== drawn) {
        drawn = text;
        node.replaceChildren(
          ...presets.map((preset) => {
            const made = chip(preset.label, preset.title, () => state.set(preset.values));
            made.prepend(lead(preset));
            return made;
          }),
        );
        node.hidden = !presets.length;
      }
      for (const [i, { values }] of presets.entries()) {
        const chosen = Object.entries(values).every(([name, value]) =>
          equal(state.values[name], value),
        );
        const pressed = String(chosen);
        if (node.children[i].getAttribute("aria-pressed") === pressed) continue;
        node.children[i].setAttribute("aria-pressed", pressed);
      }
    },
  };
}
