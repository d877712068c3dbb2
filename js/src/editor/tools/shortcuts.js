/**
 * Every key of the editor, in one table: the key handler runs it and the help shows it. Rows
 * without `run` tell of keys that the part with the focus handles itself.
 */

import { openHelp } from "../../ui/help_dialog.js";
import { HISTORY_KEYS, runShortcut } from "../../ui/keys.js";

/** @typedef {import("../view/view.js").View} View */

/** Choose a tool and go to its handle, or else to the picture. @type {(tool: string) => (view: View) => void} */
const take = (tool) => (view) => {
  const node = view.toolbar.tools.find(({ value }) => value === tool)?.node;
  if (node?.matches(":disabled")) {
    view.announcer.say(node.title);
    return;
  }
  view.hand.setTool(tool);
  if (view.hand.tools[tool].focus) view.hand.tools[tool].focus();
  else view.stage.node.focus({ preventScroll: true });
};

/** @param {View} view @param {1 | -1} way */
function stepMap({ inspector, announcer }, way) {
  if (inspector.choice.disabled) announcer.say(inspector.choice.title);
  else inspector.step(way);
}

/** @param {View} view */
function stepBack(view) {
  const busy = view.hand.pointer !== null;
  view.hand.cancel();
  // One thing at a time: the gesture, the map, the tool, the full screen.
  if (!busy && view.inspector.map) view.inspector.choose("");
  else if (!busy && view.hand.tool === "sun" && view.fullScreen?.on) view.fullScreen.leave();
  else view.hand.setTool("sun");
}

/** @type {import("../../ui/keys.js").Shortcut<View>[]} */
export const SHORTCUTS = [
  { section: "Tools", keys: ["1"], label: "Move the sun", run: take("sun") },
  { section: "Tools", keys: ["2"], label: "Set the horizon", run: take("horizon") },
  { section: "Tools", keys: ["3"], label: "Point at the photo's own sun", run: take("pick") },
  { section: "Tools", keys: ["4"], label: "Brush: this is sky", run: take("sky") },
  { section: "Tools", keys: ["5"], label: "Brush: this is not sky", run: take("not_sky") },
  { section: "Tools", keys: ["6"], label: "Erase strokes", run: take("erase") },
  {
    section: "Tools",
    keys: ["Escape"],
    label: "Give up what was begun; back to the sun",
    run: stepBack,
  },

  {
    section: "Sun and horizon",
    keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
    label: "Move the handle that has the focus",
  },
  {
    section: "Sun and horizon",
    keys: ["Shift+ArrowLeft", "Shift+ArrowRight"],
    label: "Ten times as far",
  },
  { section: "Sun and horizon", keys: ["Home"], label: "Back to what was found in the photo" },

  {
    section: "Brushes",
    keys: ["["],
    label: "Smaller brush",
    run: (view) => view.hand.setBrushRadius(view.hand.brushRadius / 1.25),
  },
  {
    section: "Brushes",
    keys: ["]"],
    label: "Larger brush",
    run: (view) => view.hand.setBrushRadius(view.hand.brushRadius * 1.25),
  },
  {
    section: "Brushes",
    keys: ["W"],
    label: "Mark water or sky",
    run: (view) => view.hand.setSubject(view.hand.subject === "sky" ? "water" : "sky"),
  },

  { section: "View", keys: ["/"], label: "Find a parameter", run: (view) => view.panel.find() },
  {
    section: "View",
    keys: ["B"],
    label: "The photo as it was: held, or pressed to stay",
  },
  {
    section: "View",
    keys: ["S"],
    label: "Before and after side by side",
    run: (view) => view.split?.toggle(),
  },
  { section: "View", keys: ["F"], label: "Full screen", run: (view) => view.fullScreen?.toggle() },
  { section: "View", keys: ["+", "="], label: "Zoom in", run: (view) => view.stage.stepZoom(1) },
  { section: "View", keys: ["-"], label: "Zoom out", run: (view) => view.stage.stepZoom(-1) },
  {
    section: "View",
    keys: ["0", "Mod+0"],
    label: "All of the picture",
    run: (view) => view.stage.fit(),
  },
  {
    section: "View",
    keys: ["Z"],
    label: "100 %, or all of the picture",
    run: (view) => view.stage.toggleZoom(),
  },
  { section: "View", keys: ["Space"], label: "Held: drag the picture itself" },
  {
    section: "Picture, when it has the focus",
    keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
    label: "Move the cross; a zoomed picture follows it",
  },
  {
    section: "Picture, when it has the focus",
    keys: ["Enter", "Space"],
    label: "Use the tool at the cross; a brush stays down until the next press",
  },
  {
    section: "View",
    keys: ["M"],
    label: "Next map of the analysis",
    run: (view) => stepMap(view, 1),
  },
  {
    section: "View",
    keys: ["Shift+M"],
    label: "Map before",
    run: (view) => stepMap(view, -1),
  },

  ...HISTORY_KEYS,
  {
    section: "History",
    keys: ["V"],
    label: "Versions: keep this edit, go to another",
    run: (view) => view.toolbar.versions?.click(),
  },
  { section: "History", keys: ["Mod+V"], label: "Paste a recipe or a photo" },

  {
    section: "Export",
    keys: ["E"],
    label: "Stills and films: format, size, key frames",
    run: (view) => view.toolbar.export?.click(),
  },

  {
    section: "Help",
    keys: ["?"],
    label: "These keys",
    run: (view) => showKeys(view),
  },
];

/** @param {View} view */
export function showKeys(view) {
  const note = view.drawing.speed && `Drawing here: ${view.drawing.speed}`;
  openHelp(view.root, "Keys of the sun editor", SHORTCUTS, note);
}

/**
 * @param {View} view
 * @param {KeyboardEvent} event
 */
export const onShortcut = (view, event) => runShortcut(SHORTCUTS, view, event);
