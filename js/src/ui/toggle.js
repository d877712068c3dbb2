/** A labeled switch for one on/off parameter. */

import { element } from "./element.js";

/**
 * @param {{ parameter: Pick<import("../host/types.js").Parameter, "name" | "label" | "help" | "default">,
 *   onChange: (on: boolean) => void, color?: string }} options `color` is a CSS color that matches the
 *   switch to a plot's line
 */
export function toggle({ parameter: p, onChange, color }) {
  let on = true;
  const button = element("button", {
    type: "button",
    role: "switch",
    class: "sw-switch",
    "aria-label": p.label,
    "aria-checked": "true",
  });
  const label = element("span", { class: "sw-label" }, p.label);
  const node = element(
    "div",
    { class: "sw-toggle", title: p.help, "data-parameter": p.name || null },
    label,
    button,
  );
  if (color) {
    const dot = element("span", { class: "sw-toggle-dot" });
    dot.style.background = color;
    label.prepend(dot);
  }
  const flip = () => onChange(!on);
  button.addEventListener("click", flip);
  label.addEventListener("click", flip);
  return {
    node,
    /** @param {boolean} value */
    show(value) {
      on = value;
      button.setAttribute("aria-checked", String(value));
      node.classList.toggle("sw-default", value === p.default);
    },
  };
}
