/** How large the picture is shown, and buttons for it, in the corner of the stage. */

import { button } from "../controls/button.js";
import { element, setAttributes } from "../controls/element.js";

/** @type {import("./parts.js").MakePart} */
export function zoomControl(view) {
  const { stage } = view;
  const smaller = button({
    icon: "minus",
    label: "Zoom out",
    title: "Zoom out (−)",
    onClick: () => stage.stepZoom(-1),
  });
  const larger = button({
    icon: "plus",
    label: "Zoom in",
    title: "Zoom in (+)",
    onClick: () => stage.stepZoom(1),
  });
  const percent = element("button", { type: "button", class: "sw-button sw-percent" });
  percent.addEventListener("click", () => stage.toggleZoom());
  stage.node.append(
    element(
      "div",
      { class: "sw-zoom-control", role: "group", "aria-label": "Zoom" },
      smaller,
      percent,
      larger,
    ),
  );
  return {
    draw() {
      const { zoom } = stage;
      const [least, most] = zoom.bounds;
      const text = `${Math.round(100 * zoom.scale)} %`;
      if (percent.textContent !== text) percent.textContent = text;
      setAttributes(percent, {
        "aria-label": `Zoom: ${text}${zoom.fits ? ", all of the picture" : ""}`,
        title: zoom.fits ? "Show 100 % (Z)" : "Show all of the picture (0 or Z)",
      });
      smaller.disabled = zoom.scale <= least;
      larger.disabled = zoom.scale >= most;
    },
    drawn(scale) {
      stage.setFull(scale === 1);
    },
  };
}
