/** A box that opens under a button, in the page's top layer so that nothing clips it. */

import { element } from "./element.js";

const MARGIN = 8; // CSS pixels to the edge of the window
const ENOUGH = 260; // room below under which the box opens upward if there is more room

/**
 * The button opens and closes it; Escape and a click elsewhere close it. While open, it handles its
 * own keys.
 *
 * @param {{ anchor: HTMLButtonElement, attributes: Record<string, string>, onOpen?: () => void,
 *   onOpened?: () => void, onClosed?: () => void }} options `onOpen` runs before it is shown, `onOpened`
 *   after, for instance to set the focus
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
    onOpened?.(); // at once, not on the event: the next key may come before it
  };
  // As the popover's target, a click on the button does not close the box first.
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
