/** Lays out the pictures of a comparison and the divider between two. */

import { columns } from "./columns.js";

const TALLEST = 680; // CSS pixels of all pictures together

/**
 * Place every picture; returns false while there is no room.
 *
 * @param {import("./types.js").Needs<"divider" | "grid" | "panels" | "root" | "shown" | "wipes"
 *   | "zoom">} view
 */
export function layOut(view) {
  const { grid, zoom, panels, wipes } = view;
  const room = grid.clientWidth;
  if (!room) return false;
  const aspect = zoom.size[0] / zoom.size[1];
  const shown = view.shown();
  const found = columns(wipes ? 1 : shown.length, room, TALLEST, aspect);
  const [width, height] = [Math.floor(found.width), Math.round(found.width / aspect)];
  grid.style.gridTemplateColumns = `repeat(${found.columns}, ${width}px)`;
  grid.style.gridAutoRows = `${height}px`;
  zoom.setRoom({
    width,
    height,
    fit: { x: 0, y: 0, width, height },
    pixelRatio: window.devicePixelRatio || 1,
  });
  const box = zoom.box();
  for (const panel of panels) {
    const { node, picture } = panel;
    node.hidden = !shown.includes(panel);
    node.classList.toggle("sw-under", wipes && panel === shown[0]);
    node.classList.toggle("sw-over", wipes && panel === shown[1]);
    Object.assign(picture.style, {
      left: `${box.x}px`,
      top: `${box.y}px`,
      width: `${box.width}px`,
      height: `${box.height}px`,
    });
  }
  view.root.classList.toggle("sw-pixels", zoom.scale >= 2);
  placeDivider(view);
  return true;
}

/**
 * Place the divider and clip the upper picture to it.
 *
 * @param {import("./types.js").Needs<"divider" | "panels" | "shown" | "wipes">} view
 */
export function placeDivider(view) {
  const { divider, panels, wipes } = view;
  for (const { canvas } of panels) canvas.style.clipPath = "";
  if (!wipes) {
    divider.node.remove();
    return;
  }
  const [under, over] = view.shown();
  if (divider.node.parentElement !== over.node) over.node.append(divider.node);
  divider.divide(over.rectangle(), over.canvas, [under.variant.label, over.variant.label]);
}
