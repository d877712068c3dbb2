/** Tools, history, before/after and saving. */

import { button, holdButton, radioButtons } from "../../ui/button.js";
import { element } from "../../ui/element.js";
import { historyButtons } from "../../ui/history_buttons.js";
import { menuButton } from "../../ui/menu.js";
import { BRUSHES } from "./strokes.js";

/** @typedef {ReturnType<typeof toolbar>} Toolbar */

/** @type {{ value: string, icon: import("../../ui/icons.js").IconName, label: string, title: string }[]} */
const TOOLS = [
  {
    value: "sun",
    icon: "sun",
    label: "Move the sun",
    title: "Move the sun (1): drag it, even out of the picture",
  },
  {
    value: "horizon",
    icon: "horizon",
    label: "Set the horizon",
    title: "Set the horizon (2): drag the line or its ends",
  },
  {
    value: "pick",
    icon: "pick",
    label: "Point at the photo's sun",
    title: "Point at the photo's own sun (3)",
  },
  {
    value: "sky",
    icon: "sky",
    label: "Brush: sky",
    title: "Brush: this is sky (4). [ and ] change its size",
  },
  {
    value: "not_sky",
    icon: "not_sky",
    label: "Brush: not sky",
    title: "Brush: this is not sky (5). [ and ] change its size",
  },
  {
    value: "erase",
    icon: "erase",
    label: "Erase strokes",
    title: "Erase whole strokes (6)",
  },
];

// Their texts name what the brush marks.
const PAINTS = TOOLS.filter(({ label }) => label.startsWith("Brush"));

/**
 * @param {import("../types.js").Needs<"hand" | "inspector" | "original" | "picture" | "state"
 *   | "work">} needs
 */
export function toolbar({ hand, inspector, original, picture, state, work }) {
  const tools = radioButtons({
    label: "Tool",
    choices: TOOLS,
    value: hand.tool,
    onChange: (tool) => hand.setTool(tool),
  });
  const presets = () => picture.scene?.presets ?? [];
  const history = historyButtons(state, "Reset everything to the photo", presets);
  const before = holdButton({
    icon: "before",
    label: "Before",
    title: "Show the original photo: hold to peek, click to toggle (B)",
    onChange: (on) => original.setBefore(on),
  });
  const saveButton = button({
    icon: "save",
    label: "Save",
    title: "Render at full size and download",
    caption: true,
  });
  const size = element("input", {
    type: "range",
    class: "sw-range sw-brush-size",
    min: 0.003,
    max: 0.06,
    step: 0.001,
    "aria-label": "Brush size",
  });
  size.addEventListener("input", () => hand.setBrushRadius(Number(size.value)));
  const water = button({
    icon: "water",
    label: "Water",
    title: "Brushes mark water instead of sky (W)",
    caption: true,
    onClick: () => hand.setSubject(hand.subject === "sky" ? "water" : "sky"),
  });
  const menu = menuButton({
    icon: "menu",
    label: "Menu",
    title: "Menu: photos, recipes and more",
    groups: ["photo", "recipe", "picture", "help"],
  });
  const node = element("div", { class: "sw-toolbar", role: "group", "aria-label": "Sun editor" });
  const end = element(
    "div",
    { class: "sw-group sw-end" },
    inspector.choice,
    before.node,
    saveButton,
    menu.node,
  );
  node.append(tools.node, water, size, history.node, end);
  return {
    node,
    end,
    history: history.node,
    /** @type {HTMLButtonElement | null} opens the list of versions */
    versions: null,
    /** @type {HTMLButtonElement | null} opens the export panel */
    export: null,
    menu,
    before,
    save: saveButton,
    /** The tools' buttons by name. */
    tools: TOOLS.map(({ value }, i) => ({
      value,
      node: /** @type {HTMLElement} */ (tools.node.children[i]),
    })),
    show() {
      if (original.isOutdated()) before.letGo();
      tools.show(hand.tool);
      history.show();
      saveButton.disabled = !picture.scene || work.busy;
      for (const { value, label, title } of PAINTS) {
        tools.rename(value, label.replace("sky", hand.subject), title.replace("sky", hand.subject));
      }
      water.hidden = !PAINTS.some(({ value }) => value === hand.tool);
      water.setAttribute("aria-pressed", String(hand.subject === "water"));
      size.hidden = !BRUSHES.includes(hand.tool);
      size.value = String(hand.brushRadius);
      size.style.setProperty("--sw-share", String((hand.brushRadius - 0.003) / 0.057));
    },
  };
}
