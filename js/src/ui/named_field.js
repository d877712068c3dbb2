/** Input fields with a label above. */

import { element } from "./element.js";

/** @typedef {Record<string, string | number | boolean>} Attributes */

/** @param {string} label @param {Attributes} attributes of the input */
export function inputField(label, attributes) {
  const input = element("input", { class: "sw-input", "aria-label": label, ...attributes });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") input.blur();
    event.stopPropagation(); // letters are text, not shortcuts
  });
  return { node: withLabel(label, input), input };
}

/**
 * @param {string} label
 * @param {[string, string][]} options value and displayed text
 */
export function selectField(label, options = []) {
  const select = element("select", { class: "sw-select", "aria-label": label });
  /** @param {[string, string][]} choices */
  const setOptions = (choices) => {
    const { value } = select;
    select.replaceChildren(...choices.map(([value, text]) => element("option", { value }, text)));
    if (choices.some((choice) => choice[0] === value)) select.value = value;
  };
  setOptions(options);
  return { node: withLabel(label, select), select, setOptions };
}

/** @param {string} label @param {HTMLElement} control */
const withLabel = (label, control) =>
  element(
    "label",
    { class: "sw-named-field" },
    element("span", { class: "sw-label" }, label),
    control,
  );
