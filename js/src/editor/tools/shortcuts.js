/**
 * All keys of the editor in one table, for the key handler and the help. Rows without `run` document
 * keys that the focused part handles itself.
 */

import { openHelp } from "../../ui/help_dialog.js";
import { HISTORY_KEYS, runShortcut, zoomKeys } from "../../ui/keys.js";

/**
 * @typedef {import("../types.js").Needs<"announcer" | "drawing" | "fullScreen" | "hand"
 *   | "inspector" | "panel" | "root" | "split" | "stage" | "state" | "toolbar">} Reach what the
 *   keys reach
 */

/** Select a tool and focus its handle, or else the picture. @type {(tool: string) => (editor: Reach) => void} */
const selectTool =
  (tool) =>
  ({ announcer, hand, stage, toolbar }) => {
    const node = toolbar.tools.find(({ value }) => value === tool)?.node;
    if (node?.matches(":disabled")) {
      announcer.say(node.title);
      return;
    }
    hand.setTool(tool);
    if (hand.tools[tool].focus) hand.tools[tool].focus();
    else stage.node.focus({ preventScroll: true });
  };

/** @param {Reach} editor @param {1 | -1} direction */
function stepMap({ inspector, announcer }, direction) {
  if (inspector.choice.disabled) announcer.say(inspector.choice.title);
  else inspector.step(direction);
}

/** @param {Reach} editor */
function stepBack({ fullScreen, hand, inspector }) {
  const busy = hand.pointer !== null;
  hand.cancel();
  // Leave one thing at a time: the gesture, the map, the tool, full screen.
  if (!busy && inspector.map) inspector.choose("");
  else if (!busy && hand.tool === "sun" && fullScreen.on) fullScreen.leave();
  else hand.setTool("sun");
}

/** @type {import("../../ui/keys.js").Shortcut<Reach>[]} */
export const SHORTCUTS = [
  { section: "Tools", keys: ["1"], label: "Move the sun", run: selectTool("sun") },
  { section: "Tools", keys: ["2"], label: "Set the horizon", run: selectTool("horizon") },
  { section: "Tools", keys: ["3"], label: "Point at the photo's own sun", run: selectTool("pick") },
  { section: "Tools", keys: ["4"], label: "Brush: this is sky", run: selectTool("sky") },
  { section: "Tools", keys: ["5"], label: "Brush: this is not sky", run: selectTool("not_sky") },
  { section: "Tools", keys: ["6"], label: "Erase strokes", run: selectTool("erase") },
  {
    section: "Tools",
    keys: ["Escape"],
    label: "Cancel; back to the sun tool",
    run: stepBack,
  },

  {
    section: "Sun and horizon",
    keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
    label: "Move the focused handle",
  },
  {
    section: "Sun and horizon",
    keys: ["Shift+ArrowLeft", "Shift+ArrowRight"],
    label: "Ten times as far",
  },
  { section: "Sun and horizon", keys: ["Home"], label: "Back to the value found in the photo" },

  {
    section: "Brushes",
    keys: ["["],
    label: "Smaller brush",
    run: ({ hand }) => hand.setBrushRadius(hand.brushRadius / 1.25),
  },
  {
    section: "Brushes",
    keys: ["]"],
    label: "Larger brush",
    run: ({ hand }) => hand.setBrushRadius(hand.brushRadius * 1.25),
  },
  {
    section: "Brushes",
    keys: ["W"],
    label: "Brush water or sky",
    run: ({ hand }) => hand.setSubject(hand.subject === "sky" ? "water" : "sky"),
  },

  { section: "View", keys: ["/"], label: "Find a parameter", run: ({ panel }) => panel.find() },
  {
    section: "View",
    keys: ["B"],
    label: "Original photo: hold to peek, tap to toggle",
  },
  {
    section: "View",
    keys: ["S"],
    label: "Before and after side by side",
    run: ({ split }) => split.toggle(),
  },
  {
    section: "View",
    keys: ["F"],
    label: "Full screen",
    run: ({ fullScreen }) => fullScreen.toggle(),
  },
  ...zoomKeys("View", ({ stage }) => stage.zoom),
  { section: "View", keys: ["Space"], label: "Hold: drag the picture" },
  {
    section: "Picture, when focused",
    keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
    label: "Move the cross; a zoomed picture follows it",
  },
  {
    section: "Picture, when focused",
    keys: ["Enter", "Space"],
    label: "Use the tool at the cross; a brush stays down until the next press",
  },
  {
    section: "View",
    keys: ["M"],
    label: "Next analysis map",
    run: (editor) => stepMap(editor, 1),
  },
  {
    section: "View",
    keys: ["Shift+M"],
    label: "Previous map",
    run: (editor) => stepMap(editor, -1),
  },

  ...HISTORY_KEYS,
  {
    section: "History",
    keys: ["V"],
    label: "Versions: keep this edit or go to another",
    run: ({ toolbar }) => toolbar.versions?.click(),
  },
  { section: "History", keys: ["Mod+V"], label: "Paste a recipe or a photo" },

  {
    section: "Export",
    keys: ["E"],
    label: "Stills and films: format, size, key frames",
    run: ({ toolbar }) => toolbar.export?.click(),
  },

  {
    section: "Help",
    keys: ["?"],
    label: "Show these keys",
    run: showKeys,
  },
];

/** @param {Pick<Reach, "drawing" | "root">} editor */
export function showKeys({ drawing, root }) {
  const note = drawing.speed && `Drawing here: ${drawing.speed}`;
  openHelp(root, "Keys of the sun editor", SHORTCUTS, note);
}

/** Listen to the keys. @param {Reach} editor @param {AbortSignal} signal */
export function shortcuts(editor, signal) {
  const onKey = (/** @type {KeyboardEvent} */ event) => runShortcut(SHORTCUTS, editor, event);
  editor.root.addEventListener("keydown", onKey, { signal });
  return {};
}
