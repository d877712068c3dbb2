/** A labelled drop-down for one choice of the parameter table. */

import { element } from "./element.js";

/**
 * @param {{ parameter: import("../types.js").Parameter, onChange: (value: string) => void,
 *   names?: Record<string, string> }} options `names` are what people read instead of the values
 */
export function choice({ parameter: p, onChange, names = {} }) {
  const select = element("select", { class: "sw-select", "aria-label": p.label });
  for (const value of p.choices) {
    select.append(element("option", { value }, names[value] ?? value.replaceAll("_", " ")));
  }
  select.addEventListener("change", () => onChange(select.value));
  const node = element(
    "div",
    { class: "sw-choice", title: p.help, "data-parameter": p.name },
    element("span", { class: "sw-label" }, p.label),
    select,
  );
  return {
    node,
    /** @param {string} value */
    show(value) {
      select.value = value;
      node.classList.toggle("sw-default", value === p.default);
    },
  };
}
