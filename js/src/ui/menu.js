/** A menu button that follows the ARIA practices. */

import { button } from "./button.js";
import { element, setAttributes } from "./element.js";
import { popup } from "./popup.js";

/**
 * @typedef {{
 *   label: string,
 *   run: () => void,
 *   group?: string,
 *   keys?: string,
 *   title?: string,
 *   enabled?: () => boolean,
 *   shown?: () => boolean,
 * }} MenuItem `group` is one of the menu's; `keys` names a shortcut; `enabled` and `shown` are
 *   called whenever the menu opens; a disabled item's `title` should give the reason
 */

/**
 * Parts add items with `add`; lines separate the groups, in the given order.
 *
 * @param {{ icon: import("./icons.js").IconName, label: string, title?: string,
 *   groups: string[] }} options
 */
export function menuButton({ groups, ...options }) {
  const trigger = button(options);
  trigger.setAttribute("aria-haspopup", "menu");
  /** @type {{ item: MenuItem, node: HTMLElement }[]} */
  const entries = [];
  const box = popup({
    anchor: trigger,
    attributes: { role: "menu", "aria-label": options.label, class: "sw-menu" },
    onOpen: () => {
      for (const { item, node } of entries) {
        node.hidden = item.shown ? !item.shown() : false;
        const off = item.enabled ? !item.enabled() : false;
        setAttributes(node, { "aria-disabled": off ? "true" : null });
      }
      for (const part of parts.values()) {
        part.hidden = [...part.children].every((node) => /** @type {HTMLElement} */ (node).hidden);
      }
    },
    onOpened: () => focus(fromEnd ? -1 : 0),
    // A click elsewhere has already moved the focus there.
    onClosed: () => {
      fromEnd = false;
    },
  });
  let fromEnd = false;
  /** @type {Map<string, HTMLElement>} */
  const parts = new Map();
  for (const name of groups) {
    const part = element("div", { role: "group", class: "sw-menu-group", hidden: true });
    parts.set(name, part);
    box.node.append(part);
  }

  const visible = () => [...parts.values()].flatMap((part) => shownIn(part));
  /** @param {number} index */
  const focus = (index) => visible().at(index)?.focus();

  /** @param {MenuItem} item */
  const add = (item) => {
    const part = parts.get(item.group ?? groups[0]);
    if (!part) throw new Error(`The menu has no group "${item.group}".`);
    const node = element(
      "button",
      { type: "button", role: "menuitem", tabindex: -1, class: "sw-menu-item", title: item.title },
      element("span", {}, item.label),
    );
    if (item.keys) node.append(element("kbd", { class: "sw-menu-keys" }, item.keys));
    node.addEventListener("click", () => {
      if (node.getAttribute("aria-disabled")) return;
      box.close();
      trigger.focus();
      item.run();
    });
    node.addEventListener("pointerenter", () => node.focus({ preventScroll: true }));
    entries.push({ item, node });
    part.append(node);
  };

  trigger.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    event.preventDefault();
    event.stopPropagation();
    fromEnd = event.key === "ArrowUp";
    box.open();
  });
  box.node.addEventListener("keydown", (event) => {
    const items = visible();
    const at = items.indexOf(/** @type {HTMLElement} */ (event.target));
    if (event.key === "ArrowDown") focus((at + 1) % items.length);
    else if (event.key === "ArrowUp") focus(at <= 0 ? -1 : at - 1);
    else if (event.key === "Home") focus(0);
    else if (event.key === "End") focus(-1);
    else if (event.key === "Tab" || event.key === "Escape") {
      box.close();
      trigger.focus();
    } else if (event.key.length === 1 && event.key !== " ") {
      const letter = event.key.toLowerCase();
      const after = [...items.slice(at + 1), ...items.slice(0, at + 1)];
      after.find((node) => node.textContent?.trim().toLowerCase().startsWith(letter))?.focus();
    } else return;
    event.preventDefault();
  });
  return { node: element("div", { class: "sw-menu-anchor" }, trigger, box.node), trigger, add };
}

/** @param {HTMLElement} part @returns {HTMLElement[]} */
const shownIn = (part) =>
  /** @type {HTMLElement[]} */ ([...part.children]).filter((node) => !node.hidden);
