/**
 * Makes the parts of the editor's view. A part takes only what it needs, adds its nodes where they
 * belong (`stage`, `toolbar.end`, `panel.section(name)`, `statusBar.node`) and receives events
 * (`part.js`).
 */

import { exportPanel } from "./export/export_panel.js";
import { saving } from "./export/save.js";
import { histogram } from "./inspect/histogram.js";
import { presetThumbnails } from "./panel/preset_thumbnails.js";
import { Thumbnails } from "./panel/thumbnails.js";
import { placeSection } from "./place/place_section.js";
import { SunClock } from "./place/sun_clock.js";
import { autosave } from "./recipe/autosave.js";
import { recipe } from "./recipe/recipe.js";
import { versions } from "./recipe/versions.js";
import { cross } from "./tools/cross.js";
import { heldKeys } from "./tools/held_keys.js";
import { help } from "./tools/help.js";
import { hover } from "./tools/hover.js";
import { ownSun } from "./tools/own_sun.js";
import { shortcuts } from "./tools/shortcuts.js";
import { announcements } from "./view/announcements.js";
import { detail } from "./view/detail.js";
import { drop } from "./view/drop.js";
import { FullScreen } from "./view/full_screen.js";
import { kernelRequired } from "./view/kernel_required.js";
import { notes } from "./view/notes.js";
import { progress } from "./view/progress.js";
import { saved } from "./view/saved.js";
import { Split } from "./view/split.js";
import { timings } from "./view/timings.js";
import { zoomControl } from "./view/zoom_control.js";

/**
 * @param {import("./view/view.js").View} view
 * @param {AbortSignal} signal
 * @returns {import("./part.js").Part[]}
 */
export function makeParts(view, signal) {
  const { announcer, channel, drawing, statusBar, hand, inspector, kernel, message, model } = view;
  const { notices, original, panel, parts, picture, root, stage, state, strokes } = view;
  const { toolbar, work } = view;
  const clock = new SunClock({ model, picture, state });
  const thumbnails = new Thumbnails({ drawing, hand, picture, stage, state }, signal);
  // This is also the order of their nodes.
  const onPicture = [
    zoomControl({ stage }, signal),
    timings({ drawing, statusBar }, signal),
    detail({ channel, hand, kernel, picture, root, stage, state, work }, signal),
    hover({ statusBar, hand, picture, stage }, signal),
    notes({ announcer, statusBar, hand, kernel, notices, picture, stage, state }, signal),
    ownSun({ hand, kernel, picture, root, stage, state }, signal),
    cross({ announcer, hand, parts, picture, stage }, signal),
    heldKeys({ root, toolbar }, signal),
  ];
  const split = new Split({ original, stage, toolbar });
  const fullScreen = new FullScreen({ root, toolbar }, signal);
  return [
    ...onPicture,
    split,
    presetThumbnails({ panel, picture, state, thumbnails }, signal),
    histogram({ drawing, panel, stage, state }, signal),
    placeSection({ clock, hand, kernel, model, panel, parts, picture, stage, state }, signal),
    versions({ notices, state, toolbar }, signal),
    drop({ channel, kernel, message, model, notices, root, stage, state, toolbar }, signal),
    recipe({ channel, kernel, message, model, notices, root, state, toolbar }, signal),
    saving({ channel, drawing, kernel, model, picture, stage, toolbar, work }, signal),
    exportPanel(
      {
        channel,
        clock,
        drawing,
        statusBar,
        kernel,
        notices,
        parts,
        picture,
        stage,
        state,
        thumbnails,
        toolbar,
        work,
      },
      signal,
    ),
    autosave({ hand, kernel, model, notices, parts, picture, state, toolbar }, signal),
    saved({ drawing, model, panel, picture, root, stage }, signal),
    help({ drawing, root, toolbar }, signal),
    progress({ channel, kernel, model, notices, picture, stage, work }, signal),
    kernelRequired({ hand, inspector, kernel, panel, root, state, toolbar }, signal),
    announcements({ announcer, statusBar, hand, model, root, strokes, toolbar }, signal),
    shortcuts(
      {
        announcer,
        drawing,
        fullScreen,
        hand,
        inspector,
        panel,
        root,
        split,
        stage,
        state,
        toolbar,
      },
      signal,
    ),
  ];
}
