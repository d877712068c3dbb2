/**
 * What hangs on the editor's view, each in a room of its own. A part puts its nodes where they
 * belong (`view.stage`, `view.toolbar.end`, `view.panel.section(name)`, `view.foot.node`) and is told:
 *
 *   loaded(scene)  the analysis, or an answer to a correction, has arrived
 *   show()         the edit or the history changed: controls follow at once
 *   draw()         the overlay is drawn: layout, zoom or edit changed
 *   drawn(scale)   a frame stands on the canvas, at a share of its full size
 *   point(place)   the pointer, or the keyboard's cross, is at a place of the picture, or gone
 */

import { announcements } from "./announcements.js";
import { autosave } from "./autosave.js";
import { cross } from "./cross.js";
import { detail } from "./detail.js";
import { drop } from "./drop.js";
import { exportPanel } from "./export_panel.js";
import { fullScreen } from "./full_screen.js";
import { heldKeys } from "./held_keys.js";
import { help } from "./help.js";
import { histogram } from "./histogram.js";
import { hover } from "./hover.js";
import { needsKernel } from "./needs_kernel.js";
import { notes } from "./notes.js";
import { ownSun } from "./own_sun.js";
import { placeSection } from "./place_section.js";
import { presetThumbnails } from "./preset_thumbnails.js";
import { progress } from "./progress.js";
import { recipe } from "./recipe.js";
import { webPage } from "./save.js";
import { saved } from "./saved.js";
import { split } from "./split.js";
import { versions } from "./versions.js";
import { zoomControl } from "./zoom_control.js";

/**
 * @typedef {{
 *   loaded?: (scene: import("../types.js").Scene) => void,
 *   show?: () => void,
 *   draw?: () => void,
 *   drawn?: (scale: number) => void,
 *   point?: (place: import("../types.js").Point | null) => void,
 * }} Part
 * @typedef {(view: import("./view.js").View, signal: AbortSignal) => Part} MakePart
 */

/** @type {MakePart[]} */
const PARTS = [
  zoomControl,
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
 * @param {import("./view.js").View} view
 * @param {AbortSignal} signal
 * @returns {Part[]}
 */
export const makeParts = (view, signal) => PARTS.map((make) => make(view, signal));
