/**
 * The keyboard's pointer: a cross on the picture while the stage has the focus.
 *
 * Arrow keys move it and the zoomed picture follows, so that they pan, too. Enter is the button:
 * pressed it uses the tool at the cross, held it drags with the arrow keys.
 */

import { setAttributes, shape } from "../controls/element.js";

/** @typedef {import("../types.js").Point} Point */

const STEP = 16; // CSS pixels; with Shift ten times as many, with Alt one
/** @type {Record<string, Point>} */
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @type {import("./parts.js").MakePart} */
export function cross(view, signal) {
  const { stage } = view;
  const node = shape(
    "g",
    { class: "sw-cross", "aria-hidden": "true" },
    shape("path", { d: "M-14 0H-4M4 0H14M0 -14V-4M0 4V14" }),
    shape("path", { d: "M-14 0H-4M4 0H14M0 -14V-4M0 4V14" }),
  );
  stage.overlay.append(node);
  /** @type {Point} */
  let place = [0.5, 0.5];
  let pressed = false;
  const tool = () => view.tools[view.tool];
  // What tools read of a pointer's event.
  const as = (/** @type {KeyboardEvent} */ event) => /** @type {any} */ (event);

  const tell = () => view.point(place);
  const release = () => {
    if (!pressed) return;
    pressed = false;
    tool().end();
  };

  /** @param {Point} way @param {KeyboardEvent} event */
  const walk = ([dx, dy], event) => {
    const step = event.altKey ? 1 : STEP * (event.shiftKey ? 10 : 1);
    const box = stage.rectangle();
    const held = (/** @type {number} */ at) => Math.min(1, Math.max(0, at));
    place = [held(place[0] + (dx * step) / box.width), held(place[1] + (dy * step) / box.height)];
    if (pressed) tool().move(place, as(event));
    else tool().hover?.(place);
    stage.bring(place);
    view.drawOverlay();
    tell();
  };

  /** @param {KeyboardEvent} event */
  const onKey = (event) => {
    if (event.target !== stage.node || event.ctrlKey || event.metaKey) return;
    const way = WAYS[event.key];
    if (way) walk(way, event);
    else if (event.key === "Enter") {
      if (!event.repeat && view.scene && view.pointer === null) {
        pressed = true;
        tool().begin(place, as(event));
      }
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };

  stage.node.addEventListener("keydown", onKey, { signal });
  stage.node.addEventListener(
    "keyup",
    (event) => {
      if (event.key === "Enter") release();
    },
    { signal },
  );
  stage.node.addEventListener(
    "focus",
    () => {
      // Where the eye is: the middle of what is in sight.
      if (!stage.zoom.fits) place = stage.zoom.placeAt(stage.zoom.middle());
      view.drawOverlay();
      if (stage.node.matches(":focus-visible")) tell();
    },
    { signal },
  );
  stage.node.addEventListener(
    "blur",
    () => {
      release();
      tool().hover?.(null);
      view.point(null);
    },
    { signal },
  );

  return {
    draw() {
      const [x, y] = stage.onOverlay(place);
      setAttributes(node, { transform: `translate(${x} ${y})` });
    },
  };
}
