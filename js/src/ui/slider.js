/** A labeled slider with a value field, for one number of the parameter table. */

import { element, setAttributes } from "./element.js";
import { typedNumber } from "./typed_number.js";

const REFUSED_MS = 4000;

/**
 * @typedef {{
 *   node: HTMLElement,
 *   show: (value: number | null, automatic: number | undefined) => void,
 * }} Slider
 */

/**
 * @param {{
 *   parameter: import("../host/types.js").Parameter,
 *   onBegin: () => void,
 *   onInput: (value: number | null) => void,
 *   onCommit: () => void,
 * }} options `onInput(null)` returns an automatic parameter to the analysis's value
 * @returns {Slider}
 */
export function slider({ parameter: p, onBegin, onInput, onCommit }) {
  const decimals = Math.max(0, Math.ceil(-Math.log10(p.step) - 1e-9));
  const bounds = { min: p.minimum, max: p.maximum, step: p.step };
  const range = element("input", {
    ...bounds,
    type: "range",
    // Steps apply to keys and the field; a pointer is as fine as the screen.
    "aria-label": p.unit ? `${p.label} in ${p.unit}` : p.label,
    class: "sw-range",
  });
  const field = element("input", {
    type: "text",
    inputmode: "decimal",
    class: "sw-field",
    "aria-label": `${p.label}, value`,
    spellcheck: "false",
    autocomplete: "off",
  });
  const automatic = p.default === null;
  const found = element("span", { class: "sw-found", title: "Found in the photo" }, "auto");
  const back = element(
    "button",
    {
      type: "button",
      class: "sw-back",
      title: automatic
        ? "Return to the value found in the photo (double-click)"
        : "Return to the default (double-click)",
      "aria-label": automatic ? `Reset ${p.label} to auto` : `Reset ${p.label}`,
    },
    automatic ? "auto" : "↺",
  );
  const node = element(
    "div",
    { class: "sw-slider", title: p.help, "data-parameter": p.name || null },
    element("span", { class: "sw-label" }, p.label),
    automatic ? found : "",
    back,
    element("span", { class: "sw-value" }, field, element("span", { class: "sw-unit" }, p.unit)),
    range,
  );

  let shown = "";
  /** @type {unknown[]} state of the drawn row: a drag updates the whole panel at each step */
  let drawn = [];
  const reset = () => {
    onBegin();
    onInput(/** @type {number | null} */ (p.default));
    onCommit();
  };
  back.addEventListener("click", () => {
    range.focus(); // the button disappears; keep the focus in the row
    reset();
  });
  node.addEventListener("dblclick", (event) => {
    if (event.target !== field && !range.disabled) reset();
  });
  range.addEventListener("input", () => {
    onBegin();
    onInput(Number(range.value));
  });
  range.addEventListener("change", onCommit);
  field.addEventListener("focus", () => field.select());
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") field.blur();
    if (event.key === "Escape") {
      field.value = shown;
      field.blur();
    }
    const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (step) {
      event.preventDefault();
      field.value = String(Number(field.value) + step * p.step * (event.shiftKey ? 10 : 1));
      accept();
    }
    event.stopPropagation();
  });
  field.addEventListener("blur", () => {
    if (field.value !== shown) accept();
  });

  const refused = element("span", { class: "sw-refused", role: "alert" });
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  /** Show for a while that a text is not a number. @param {string} text "" clears it */
  const refuse = (text) => {
    clearTimeout(timer);
    setAttributes(field, { "aria-invalid": text ? "true" : null });
    refused.textContent = text && `“${text}” is not a number`;
    if (!text) return refused.remove();
    node.append(refused);
    timer = setTimeout(() => refuse(""), REFUSED_MS);
  };

  function accept() {
    const value = typedNumber(field.value, p);
    refuse(value === null ? field.value.trim() : "");
    if (value === null) {
      field.value = shown;
      return;
    }
    onBegin();
    onInput(value);
    onCommit();
    field.value = shown; // even if an out-of-range value changed nothing
  }

  /** Return a value's position on the track, 0–1. @param {number} value */
  const share = (value) => Math.min(1, Math.max(0, (value - p.minimum) / (p.maximum - p.minimum)));
  // A signed range is filled from its zero.
  const signed = p.minimum < 0 && p.maximum > 0;

  return {
    node,
    show(value, foundValue) {
      if (drawn.length && drawn[0] === value && drawn[1] === foundValue) return;
      drawn = [value, foundValue];
      const effective = value ?? foundValue;
      const known = effective !== undefined && effective !== null;
      const isDefault = value === p.default;
      node.classList.toggle("sw-default", isDefault);
      found.hidden = !isDefault || !known;
      back.hidden = isDefault;
      range.disabled = !known;
      shown = known ? effective.toFixed(decimals) : "";
      if (field !== field.ownerDocument.activeElement || field.value !== shown) field.value = shown;
      if (!known) return;
      range.value = String(effective);
      const unit = /^[°×]?$/.test(p.unit) ? p.unit : ` ${p.unit}`;
      setAttributes(range, {
        "aria-valuetext": `${shown}${unit}${automatic && isDefault ? ", automatic" : ""}`,
      });
      const at = share(effective);
      const home = /** @type {number | undefined} */ (p.default ?? foundValue);
      const zero = signed ? share(0) : 0;
      range.style.setProperty("--sw-share", String(Math.max(zero, at)));
      // Before the track's start, so that no gap remains.
      range.style.setProperty("--sw-low", signed ? String(Math.min(zero, at)) : "-1");
      range.style.setProperty("--sw-home", String(share(home ?? effective)));
      range.classList.toggle("sw-has-home", !isDefault && home !== undefined);
    },
  };
}
