/**
 * The keyboard's pointer: a cross on the picture while the stage has keyboard focus.
 *
 * Arrow keys move it, and a zoomed picture follows, so they also pan. Enter and space act as the
 * button: a press uses the tool at the cross; held, arrow keys drag. A brush stays down after one
 * press until the next, since few can hold one key and press others.
 */

import { directionText } from "../../ui/angle_text.js";
import { setAttributes, shape } from "../../ui/element.js";

/** @typedef {import("../../host/types.js").Point} Point */

const STEP = 16; // CSS pixels; ten times as many with Shift, one with Alt
/** @type {Record<string, Point>} */
const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @type {import("../types.js").MakePart<"announcer" | "hand" | "parts" | "picture" | "stage">} */
export function cross({ announcer, hand, parts, picture, stage }, signal) {
  const node = shape(
    "g",
    { class: "sw-cross", "aria-hidden": "true" },
    shape("path", { d: "M-14 0H-4M4 0H14M0 -14V-4M0 4V14" }),
    shape("path", { d: "M-14 0H-4M4 0H14M0 -14V-4M0 4V14" }),
  );
  stage.overlay.append(node);
  /** @type {Point} */
  let place = [0.5, 0.5];
  let shown = false;
  let pressed = false;
  let moved = false; // since the press
  const tool = () => hand.tools[hand.tool];
  // Tools read only the modifier keys of a pointer event.
  const asPointer = (/** @type {KeyboardEvent} */ event) => /** @type {any} */ (event);

  const appear = () => {
    // Start in the middle of the visible part.
    if (!shown) place = stage.zoom.placeAt(stage.zoom.middle());
    shown = true;
    stage.node.classList.add("sw-crossing");
    parts.draw();
    parts.point(place);
  };
  const disappear = () => {
    release();
    if (!shown) return;
    shown = false;
    stage.node.classList.remove("sw-crossing");
    tool().hover?.(null);
    parts.point(null);
  };
  const release = () => {
    if (!pressed) return;
    pressed = false;
    tool().end();
  };

  /** @param {Point} direction @param {KeyboardEvent} event */
  const step = ([dx, dy], event) => {
    const pixels = event.altKey ? 1 : STEP * (event.shiftKey ? 10 : 1);
    const box = stage.rectangle();
    const clamp = (/** @type {number} */ at) => Math.min(1, Math.max(0, at));
    place = [
      clamp(place[0] + (dx * pixels) / box.width),
      clamp(place[1] + (dy * pixels) / box.height),
    ];
    moved = true;
    if (pressed) tool().move(place, asPointer(event));
    else tool().hover?.(place);
    stage.zoom.bring(place);
    parts.draw();
    parts.point(place);
    announce();
  };

  const announce = () => {
    const { camera } = picture;
    if (!camera) return;
    const [x, y] = [place[0] * camera.width, place[1] * camera.height];
    announcer.say(`Cross at ${directionText(...camera.angles(x, y))}`, "cross");
  };

  /** Whether a key presses the tool. Without a cross, space pans with the mouse. @param {KeyboardEvent} event */
  const isPress = ({ key }) => key === "Enter" || (key === " " && shown);

  /** @param {KeyboardEvent} event */
  const press = (event) => {
    if (pressed) return release();
    if (!picture.scene || hand.pointer !== null) return;
    pressed = true;
    moved = false;
    tool().begin(place, asPointer(event));
  };

  /** @param {KeyboardEvent} event */
  const onKey = (event) => {
    if (event.target !== stage.node || event.ctrlKey || event.metaKey) return;
    const direction = DIRECTIONS[event.key];
    if (direction) {
      appear();
      step(direction, event);
    } else if (isPress(event)) {
      appear();
      if (!event.repeat) press(event);
    } else if (event.key === "Escape" && pressed) {
      pressed = false;
      tool().cancel();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };

  /** @type {(name: string, listener: (event: any) => void) => void} */
  const on = (name, listener) => stage.node.addEventListener(name, listener, { signal });
  on("keydown", onKey);
  on("keyup", (event) => {
    if (!pressed || !isPress(event)) return;
    if (moved || !tool().stays) release();
    else announcer.say("Brush down: arrow keys paint, Enter lifts the brush", "strokes");
  });
  on("focus", () => {
    if (!stage.focusing) appear();
  });
  on("blur", disappear);
  on("pointerdown", disappear);
  on("pointermove", (event) => {
    // A resting mouse also receives a move when the picture moves under it.
    if (event.movementX || event.movementY) disappear();
  });

  return {
    draw() {
      const [x, y] = stage.onOverlay(place);
      setAttributes(node, { transform: `translate(${x} ${y})` });
      // A tool selected in the meantime also appears here.
      if (shown && !pressed) tool().hover?.(place);
    },
  };
}
