/** The zoom buttons in the corner of the stage. */

import { zoomButtons } from "../../ui/zoom_buttons.js";

/** @type {import("../types.js").MakePart<"stage">} */
export function zoomControl({ stage }) {
  const buttons = zoomButtons(stage.zoom, "sw-zoom-control");
  stage.node.append(buttons.node);
  return {
    draw: () => buttons.show(),
    drawn: (scale) => stage.setFull(scale === 1),
  };
}
