/** The button that opens the help. */

import { button } from "../../ui/button.js";
import { showKeys } from "./shortcuts.js";

/** @type {import("../types.js").MakePart<"drawing" | "root" | "toolbar">} */
export function help({ drawing, root, toolbar }) {
  const node = button({
    icon: "help",
    label: "Keys",
    title: "Keys of the editor (?)",
    onClick: () => showKeys({ drawing, root }),
  });
  toolbar.end.append(node);
  return {};
}
