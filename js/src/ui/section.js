/** Collapsible sections of a panel. */

import { button } from "./button.js";
import { element, setAttributes } from "./element.js";
import { icon } from "./icons.js";

/**
 * @param {{ title: string, open?: boolean, className?: string }} options
 * @param {Node[]} children
 */
export function section({ title, open = true, className = "sw-section" }, ...children) {
  const body = element("div", { class: "sw-section-body" }, ...children);
  const heading = element("summary", {}, icon("chevron"), element("span", {}, title));
  return element("details", { class: className, open }, heading, body);
}

/**
 * A section that counts its changed values and resets them. Not `details`: a button inside its
 * summary is hidden from assistive technology.
 *
 * @param {{ title: string, open: boolean, onFold: (open: boolean) => void,
 *   onReset?: () => void }} options
 * @param {Node[]} children
 */
export function countedSection({ title, open, onFold, onReset }, ...children) {
  const body = element("div", { class: "sw-section-body" }, ...children);
  const count = element("span", { class: "sw-count", hidden: true });
  const fold = element(
    "button",
    { type: "button", class: "sw-fold" },
    icon("chevron"),
    element("span", { class: "sw-fold-title" }, title),
    count,
  );
  const reset = button({
    icon: "reset",
    label: `Reset ${title}`,
    onClick: () => {
      fold.focus();
      onReset?.();
    },
  });
  reset.hidden = true;
  const head = element("div", { class: "sw-section-head" }, fold, reset);
  const node = element(
    "div",
    { class: "sw-section", role: "group", "aria-label": title },
    head,
    body,
  );
  /** @param {boolean} on */
  const setOpen = (on) => {
    fold.setAttribute("aria-expanded", String(on));
    body.hidden = !on;
  };
  let shown = "";
  setOpen(open);
  fold.addEventListener("click", () => {
    const on = body.hidden !== false;
    setOpen(on);
    onFold(on);
  });
  return {
    node,
    head,
    body,
    setOpen,
    /** @param {string[]} labels of the values that are changed */
    setChanged(labels) {
      const text = labels.join(", ");
      if (text === shown) return;
      shown = text;
      const some = labels.length > 0;
      count.hidden = reset.hidden = !some;
      if (!some) return;
      count.textContent = String(labels.length);
      setAttributes(count, {
        role: "img",
        "aria-label": `${labels.length} changed`,
        title: `Changed: ${text}`,
      });
      reset.title = `Reset ${text}`;
    },
  };
}
