/**
 * What hangs on the editor's view, each in a room of its own. A part puts its nodes where they
 * belong (`view.stage`, `view.toolbar.end`, `view.panel.section(name)`, `view.foot.node`)
 * and is told of what happens (`part.js`).
 */

import { exportPanel } from "./export/export_panel.js";
import { webPage } from "./export/save.js";
import { histogram } from "./inspect/histogram.js";
import { presetThumbnails } from "./panel/preset_thumbnails.js";
import { placeSection } from "./place/place_section.js";
import { autosave } from "./recipe/autosave.js";
import { recipe } from "./recipe/recipe.js";
import { versions } from "./recipe/versions.js";
import { cross } from "./tools/cross.js";
import { heldKeys } from "./tools/held_keys.js";
import { help } from "./tools/help.js";
import { hover } from "./tools/hover.js";
import { ownSun } from "./tools/own_sun.js";
import { announcements } from "./view/announcements.js";
import { detail } from "./view/detail.js";
import { drop } from "./view/drop.js";
import { fullScreen } from "./view/full_screen.js";
import { needsKernel } from "./view/kernel_required.js";
import { notes } from "./view/notes.js";
import { progress } from "./view/progress.js";
import { saved } from "./view/saved.js";
import { split } from "./view/split.js";
import { timings } from "./view/timings.js";
import { zoomControl } from "./view/zoom_control.js";

/**
 * @typedef {import("./part.js").Part} Part
 * @typedef {(view: import("./view/view.js").View, signal: AbortSignal) => Part} MakePart
 */

/** @type {MakePart[]} */
const PARTS = [
  zoomControl,
  timings,
  detail,
  hover,
  notes,
  ownSun,
  cross,
  heldKeys,
  split,
  fullScreen,
  presetThumbnails,
  histogram,
  placeSection,
  versions,
  drop,
  recipe,
  webPage,
  exportPanel,
  autosave,
  saved,
  help,
  progress,
  needsKernel,
  announcements,
];

/**
 * @param {import("./view/view.js").View} view
 * @param {AbortSignal} signal
 * @returns {Part[]}
 */
export const makeParts = (view, signal) => PARTS.map((make) => make(view, signal));
