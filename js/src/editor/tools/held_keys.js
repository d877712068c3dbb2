/** Keys that act while held: space pans the picture, B shows the original. */

import { isTaken } from "../../ui/keys.js";

/** @type {import("../types.js").MakePart<"root" | "toolbar">} */
export function heldKeys({ root, toolbar }, signal) {
  /** @param {string} key @param {boolean} down */
  const hold = (key, down) => {
    if (key === " ") root.classList.toggle("sw-hand", down);
    else if (down) toolbar.before.press();
    else toolbar.before.release();
  };
  /** @type {Set<string>} */
  const held = new Set();
  /** @param {KeyboardEvent} event */
  const down = (event) => {
    const key = event.key.toLowerCase();
    if ((key !== " " && key !== "b") || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.defaultPrevented || isTaken(event)) return;
    event.preventDefault();
    event.stopPropagation();
    if (!held.has(key)) hold(key, true);
    held.add(key);
  };
  /** @param {string} key */
  const up = (key) => {
    if (held.delete(key)) hold(key, false);
  };
  const drop = () => {
    for (const key of held) up(key);
  };
  root.addEventListener("keydown", down, { signal });
  root.addEventListener("keyup", (event) => up(event.key.toLowerCase()), { signal });
  root.addEventListener(
    "focusout",
    ({ relatedTarget }) => {
      if (!root.contains(/** @type {Node | null} */ (relatedTarget))) drop();
    },
    { signal },
  );
  window.addEventListener("blur", drop, { signal });
  return {};
}
