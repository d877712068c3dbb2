/** Buttons of the toolbar. */

import { element, setAttributes } from "./element.js";
import { icon } from "./icons.js";

/**
 * A push button with an icon and, where it helps, a caption.
 *
 * @param {{ icon: import("./icons.js").IconName, label: string, title?: string, caption?: boolean,
 *   onClick?: () => void }} options
 */
export function button({ icon: name, label, title = label, caption = false, onClick }) {
  const node = element("button", {
    type: "button",
    class: "sw-button",
    "aria-label": label,
    title,
  });
  node.append(icon(name));
  if (caption) node.append(element("span", {}, label));
  if (onClick) node.addEventListener("click", onClick);
  return node;
}

/**
 * A group of buttons, one of which is selected.
 *
 * @param {{ label: string, choices: { value: string, icon: import("./icons.js").IconName,
 *   label: string, title: string }[], value: string, onChange: (value: string) => void }} options
 */
export function radioButtons({ label, choices, value, onChange }) {
  const group = element("div", { class: "sw-group", role: "radiogroup", "aria-label": label });
  const buttons = choices.map((choice) => {
    const node = button({ ...choice, onClick: () => onChange(choice.value) });
    node.setAttribute("role", "radio");
    group.append(node);
    return { node, value: choice.value };
  });
  /** @param {string} chosen */
  const show = (chosen) => {
    for (const { node, value: own } of buttons) {
      setAttributes(node, {
        "aria-checked": own === chosen ? "true" : "false",
        tabindex: own === chosen ? 0 : -1,
      });
    }
  };
  group.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const open = buttons.filter(({ node }) => !node.disabled);
    const at = open.findIndex(({ node }) => node === event.target);
    if (!step || at < 0) return;
    event.preventDefault();
    event.stopPropagation();
    const next = open[(at + step + open.length) % open.length];
    next.node.focus();
    onChange(next.value);
  });
  show(value);
  /** @type {(value: string, label: string, title: string) => void} */
  const rename = (value, label, title) => {
    const found = buttons.find((button) => button.value === value);
    if (found) setAttributes(found.node, { "aria-label": label, title });
  };
  return { node: group, show, rename };
}

const HOLD_MS = 300;

/**
 * A button that shows something while it is held and toggles it when it is clicked.
 *
 * @param {{ icon: import("./icons.js").IconName, label: string, title: string,
 *   onChange: (on: boolean) => void }} options
 */
export function holdButton({ onChange, ...options }) {
  const node = button({ ...options, caption: true });
  let on = false;
  let since = 0;
  /** @param {boolean} value */
  const show = (value) => {
    on = value;
    node.setAttribute("aria-pressed", String(value));
    onChange(value);
  };
  let wasOn = false;
  let pressed = false;
  const press = () => {
    pressed = true;
    since = performance.now();
    wasOn = on;
    show(true);
  };
  const release = () => {
    pressed = false;
    show(performance.now() - since < HOLD_MS && !wasOn);
  };
  node.addEventListener("pointerdown", (event) => {
    node.setPointerCapture(event.pointerId);
    press();
  });
  node.addEventListener("lostpointercapture", release);
  // Keyboard and assistive technology click without a pointer.
  node.addEventListener("click", (event) => {
    if (event.detail === 0) show(!on);
  });
  node.setAttribute("aria-pressed", "false");
  // `press` and `release` are for a held key; `letGo` ends a toggled state.
  const letGo = () => {
    if (on && !pressed) show(false);
  };
  return { node, show, press, release, letGo, isOn: () => on };
}
