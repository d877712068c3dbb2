/** Zoom buttons with the current scale. */

import { button } from "./button.js";
import { element, setAttributes } from "./element.js";

/**
 * @param {import("../geometry/zoom.js").Zoom} zoom
 * @param {string} kind CSS class of the group
 */
export function zoomButtons(zoom, kind) {
  const smaller = button({
    icon: "minus",
    label: "Zoom out",
    title: "Zoom out (−)",
    onClick: () => zoom.step(-1),
  });
  const larger = button({
    icon: "plus",
    label: "Zoom in",
    title: "Zoom in (+)",
    onClick: () => zoom.step(1),
  });
  const percent = element("button", { type: "button", class: "sw-button sw-percent" });
  percent.addEventListener("click", () => zoom.toggle());
  return {
    node: element(
      "div",
      { class: kind, role: "group", "aria-label": "Zoom" },
      smaller,
      percent,
      larger,
    ),
    show() {
      const [least, most] = zoom.bounds;
      const text = `${Math.round(100 * zoom.scale)} %`;
      if (percent.textContent !== text) percent.textContent = text;
      setAttributes(percent, {
        "aria-label": `Zoom: ${text}${zoom.fits ? ", whole picture" : ""}`,
        title: zoom.fits ? "Show 100 % (Z)" : "Show the whole picture (0 or Z)",
      });
      smaller.disabled = zoom.scale <= least;
      larger.disabled = zoom.scale >= most;
    },
  };
}
