/** The button that opens the help. */

import { button } from "../../ui/button.js";
import { showKeys } from "./shortcuts.js";

/** @type {import("../parts.js").MakePart} */
export function help(view) {
  const node = button({
    icon: "help",
    label: "Keys",
    title: "Keys of the editor (?)",
    onClick: () => showKeys(view),
  });
  view.toolbar.end.append(node);
  return {};
}
