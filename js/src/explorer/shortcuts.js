/** All keys of the explorer in one table, for the key handler and the help. */

import { turned } from "../geometry/day.js";
import { openHelp } from "../ui/help_dialog.js";
import { HISTORY_KEYS } from "../ui/keys.js";

/** @typedef {import("./types.js").Needs<"number" | "root" | "state">} Reach what the keys reach */

const TURN = 15; // degrees

/** @type {(projection: string) => (view: Reach) => void} */
const selectProjection = (projection) => (view) => view.state.set({ projection });

/** @type {(degrees: number) => (view: Reach) => void} */
const turn = (degrees) => (view) =>
  view.state.set({ view_azimuth: turned(view.number("view_azimuth") + degrees) });

/** @type {import("../ui/keys.js").Shortcut<Reach>[]} */
export const SHORTCUTS = [
  { section: "View", keys: ["1"], label: "Dome", run: selectProjection("dome") },
  { section: "View", keys: ["2"], label: "Panorama", run: selectProjection("panorama") },
  { section: "View", keys: ["3"], label: "Camera", run: selectProjection("camera") },
  { section: "View", keys: ["["], label: "Turn left", run: turn(-TURN) },
  { section: "View", keys: ["]"], label: "Turn right", run: turn(TURN) },

  {
    section: "Sun, when focused",
    keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
    label: "Move it by half a degree",
  },
  {
    section: "Sun, when focused",
    keys: ["Shift+ArrowLeft", "Shift+ArrowRight"],
    label: "Ten times as far",
  },

  ...HISTORY_KEYS,

  {
    section: "Help",
    keys: ["?"],
    label: "Show these keys",
    run: (view) => showKeys(view),
  },
];

/** @param {import("./types.js").Needs<"root">} view */
export const showKeys = (view) => openHelp(view.root, "Keys of the sky explorer", SHORTCUTS);
