/** The button that opens the help. */

import { button } from "../controls/button.js";
import { openHelp } from "../controls/help_dialog.js";
import { SHORTCUTS } from "./shortcuts.js";

/** @type {import("./parts.js").MakePart} */
export function help(view) {
  const node = button({
    icon: "help",
    label: "Keys",
    title: "Keys of the editor (?)",
    onClick: () => openHelp(view.root, "Keys of the sun editor", SHORTCUTS),
  });
  view.toolbar.end.append(node);
  return {};
}
