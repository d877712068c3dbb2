/** A box that opens under a button, in the page's top layer, so that nothing cuts it off. */

import { element } from "./element.js";

const MARGIN = 8; // CSS pixels to the edge of the window
const ENOUGH = 260; // height below which the box goes up where there is more room

/**
 * The button opens and closes it; so do Escape and a click elsewhere. While it is open its keys
 * are its own.
 *
 * @param {{ anchor: HTMLButtonElement, attributes: Record<string, string>, onOpen?: () => void,
 *   onOpened?: () => void, onClosed?: () => void }} options `onOpen` before it is shown, `onOpened`
 *   when it is, to put the focus somewhere
 */
export function popup({ anchor, attributes, onOpen, onOpened, onClosed }) {
  const node = element("div", { ...attributes, popover: "auto" });
  node.classList.add("sw-popup");
  anchor.popoverTargetElement = node;
  anchor.setAttribute("aria-expanded", "false");
  /** @param {Event} event */
  const onScroll = (event) => {
    if (!node.contains(/** @type {Node} */ (event.target))) node.hidePopover();
  };
  node.addEventListener("beforetoggle", (event) => {
    anchor.setAttribute("aria-expanded", String(event.newState === "open"));
    if (event.newState !== "open") return;
    place(node, anchor.getBoundingClientRect());
    onOpen?.();
  });
  node.addEventListener("toggle", (event) => {
    const open = event.newState === "open";
    const listen = open ? "addEventListener" : "removeEventListener";
    window[listen]("scroll", /** @type {EventListener} */ (onScroll), true);
    if (!open) onClosed?.();
  });
  const open = () => {
    node.showPopover();
    onOpened?.(); // at once, not with the event: the next key may be pressed already
  };
  // That the button belongs to the box keeps a click on it from closing the box beforehand.
  anchor.addEventListener("click", (event) => {
    event.preventDefault();
    if (node.matches(":popover-open")) node.hidePopover();
    else open();
  });
  node.addEventListener("keydown", (event) => event.stopPropagation());
  return {
    node,
    open,
    close: () => node.hidePopover(),
    get isOpen() {
      return node.matches(":popover-open");
    },
  };
}

/** @param {HTMLElement} node @param {DOMRect} box of the button, in the window */
function place(node, box) {
  const below = window.innerHeight - box.bottom;
  const up = below < ENOUGH && box.top > below;
  const fromRight = box.left + box.width / 2 > window.innerWidth / 2;
  Object.assign(node.style, {
    top: up ? "auto" : `${box.bottom + 4}px`,
    bottom: up ? `${window.innerHeight - box.top + 4}px` : "auto",
    left: fromRight ? "auto" : `${Math.max(MARGIN, box.left)}px`,
    right: fromRight ? `${Math.max(MARGIN, window.innerWidth - box.right)}px` : "auto",
    maxHeight: `${(up ? box.top : below) - 4 - MARGIN}px`,
  });
}
