/** A labeled drop-down for one choice of the parameter table. */

import { element } from "./element.js";

/**
 * @param {{ parameter: import("../host/types.js").Parameter, onChange: (value: string) => void,
 *   names?: Record<string, string> }} options `names` are display names of the values
 */
export function choice({ parameter: p, onChange, names = {} }) {
  const select = element("select", { class: "sw-select", "aria-label": p.label });
  for (const value of p.choices) {
    select.append(element("option", { value }, names[value] ?? displayName(value)));
  }
  select.addEventListener("change", () => onChange(select.value));
  const back = element(
    "button",
    {
      type: "button",
      class: "sw-back",
      title: "Return to the default (double-click)",
      "aria-label": `Reset ${p.label}`,
    },
    "↺",
  );
  const reset = () => onChange(String(p.default));
  back.addEventListener("click", () => {
    select.focus(); // the button disappears; keep the focus in the row
    reset();
  });
  const label = element("span", { class: "sw-label" }, p.label);
  label.addEventListener("dblclick", () => {
    if (!select.disabled) reset();
  });
  const node = element(
    "div",
    { class: "sw-choice", title: p.help, "data-parameter": p.name || null },
    label,
    back,
    select,
  );
  return {
    node,
    /** @param {string} value */
    show(value) {
      if (select.value === value && node.dataset.value === value) return;
      node.dataset.value = value;
      const isDefault = value === p.default;
      select.value = value;
      back.hidden = isDefault;
      node.classList.toggle("sw-default", isDefault);
    },
  };
}

/** Format a value of the table for display. @param {string} value */
const displayName = (value) => {
  const text = value.replaceAll("_", " ");
  return text[0].toUpperCase() + text.slice(1);
};
