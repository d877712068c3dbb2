/** All keys of a comparison, with those that the sun and the divider handle themselves. */

import { openHelp } from "../ui/help_dialog.js";
import { HISTORY_KEYS, isTaken, runShortcut, zoomKeys } from "../ui/keys.js";

/**
 * @typedef {import("./types.js").Needs<"model" | "root" | "setArrangement" | "setDifference"
 *   | "state" | "wipes" | "zoom">} Reach what the keys reach
 */

/** @type {import("../ui/keys.js").Shortcut<Reach>[]} */
const SHORTCUTS = [
  {
    section: "Pictures",
    keys: ["W"],
    label: "Side by side, or two with a divider",
    run: (view) => view.setArrangement(view.wipes ? "side_by_side" : "wipe"),
  },
  {
    section: "Pictures",
    keys: ["D"],
    label: "Difference from the first",
    run: (view) => view.setDifference(!view.model.get("difference")),
  },
  ...zoomKeys("Pictures", ({ zoom }) => zoom),
  { section: "Pictures", keys: ["Space"], label: "Hold: drag the pictures" },
  {
    section: "Sun, when focused",
    keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
    label: "Move it in all pictures; with Shift ten times as far",
  },
  { section: "Sun, when focused", keys: ["Home"], label: "Back to the photo's own sun" },
  {
    section: "Divider, when focused",
    keys: ["ArrowLeft", "ArrowRight"],
    label: "Move it; with Shift five times as far",
  },
  ...HISTORY_KEYS,
  {
    section: "Help",
    keys: ["?"],
    label: "Show these keys",
    run: (view) => openHelp(view.root, "Keys of the comparison", SHORTCUTS),
  },
];

/**
 * @param {Reach} view
 * @param {AbortSignal} signal
 */
export function listenToKeys(view, signal) {
  const { root } = view;
  const hand = (/** @type {boolean} */ on) => root.classList.toggle("sw-hand", on);
  root.addEventListener(
    "keydown",
    (event) => {
      if (event.key === " " && !isTaken(event)) {
        hand(true);
        event.preventDefault();
      } else runShortcut(SHORTCUTS, view, event);
    },
    { signal },
  );
  root.addEventListener("keyup", ({ key }) => key === " " && hand(false), { signal });
  root.addEventListener("focusout", () => hand(false), { signal });
}
