/** The toolbar: projection, history and code export. */

import { turned } from "../geometry/day.js";
import { button, radioButtons } from "../ui/button.js";
import { copyText } from "../ui/clipboard.js";
import { element } from "../ui/element.js";
import { historyButtons } from "../ui/history_buttons.js";
import { pythonCode } from "./code.js";
import { showKeys } from "./shortcuts.js";

/** @type {{ value: string, icon: import("../ui/icons.js").IconName, label: string, title: string }[]} */
const PROJECTIONS = [
  {
    value: "dome",
    icon: "dome",
    label: "Dome",
    title: "Dome: the whole sky as a fisheye image, zenith in the middle",
  },
  {
    value: "panorama",
    icon: "panorama",
    label: "Panorama",
    title: "Panorama: all around the horizon; drag to turn",
  },
  {
    value: "camera",
    icon: "camera",
    label: "Camera",
    title: "Camera: a perspective view; drag to look around, Ctrl+wheel to zoom",
  },
];
const SAME_PLACE = 0.01; // degrees, as in the kernel's twin
const KERNEL_PATIENCE_MS = 1500; // after which the browser writes the code

/** @param {import("./types.js").Needs<"channel" | "message" | "root" | "state" | "sun">} view */
export function toolbar(view) {
  const { state } = view;
  const projections = radioButtons({
    label: "Projection",
    choices: PROJECTIONS,
    value: String(state.values.projection),
    onChange: (projection) => state.set({ projection }),
  });
  for (const [i, node] of [...projections.node.children].entries()) {
    node.append(element("span", {}, PROJECTIONS[i].label));
  }
  const history = historyButtons(state, "Reset everything to its default");
  const copy = button({
    icon: "copy",
    label: "Copy code",
    title: "Copy Python code that recreates this sky",
    caption: true,
  });
  const help = button({
    icon: "help",
    label: "Keys",
    title: "Keys of the explorer (?)",
    onClick: () => showKeys(view),
  });
  const said = element("span", { class: "sw-said", role: "status" });
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let silence;
  copy.addEventListener("click", async () => {
    const code = await codeOf(view);
    said.textContent = (await copyText(code)) ? "Copied" : "";
    // Without a clipboard, show the code to copy by hand.
    view.message.show(said.textContent ? "" : code);
    clearTimeout(silence);
    silence = setTimeout(() => {
      said.textContent = "";
    }, 2500);
  });
  const node = element(
    "div",
    { class: "sw-toolbar", role: "group", "aria-label": "Sky explorer" },
    projections.node,
    history.node,
    element("div", { class: "sw-group sw-end" }, said, copy, help),
  );
  return {
    node,
    show() {
      projections.show(String(state.values.projection));
      history.show();
    },
  };
}

/**
 * Return the kernel's code, or the browser's if no kernel answers.
 *
 * @param {import("./types.js").Needs<"channel" | "state" | "sun">} view
 */
async function codeOf(view) {
  const [azimuth, elevation] = view.sun.automaticDirection();
  const sun = view.sun.direction();
  const follows = Math.hypot(turned(sun[0] - azimuth), sun[1] - elevation) < SAME_PLACE;
  const own = pythonCode(view.state.recipe(), follows ? null : sun);
  /** @type {Promise<string>} */
  const late = new Promise((resolve) => {
    setTimeout(() => resolve(own), KERNEL_PATIENCE_MS);
  });
  view.state.push();
  const asked = view.channel.request("code").then(
    ({ result }) => String(result.code),
    () => own,
  );
  return `import sunwidget as sw\n\n${await Promise.race([asked, late])}`;
}
