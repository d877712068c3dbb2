/**
 * The keyboard's pointer: a cross on the picture while the stage has the focus by the keyboard.
 *
 * Arrow keys move it and the zoomed picture follows, so that they pan, too. Enter and space are the
 * button: pressed they use the tool at the cross, held they drag with the arrow keys. A brush stays
 * down after one press until the next, as few can hold a key and press others.
 */

import { directionText } from "../../ui/angle_text.js";
import { setAttributes, shape } from "../../ui/element.js";

/** @typedef {import("../../host/types.js").Point} Point */

const STEP = 16; // CSS pixels; with Shift ten times as many, with Alt one
/** @type {Record<string, Point>} */
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

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
  // What tools read of a pointer's event.
  const as = (/** @type {KeyboardEvent} */ event) => /** @type {any} */ (event);

  const come = () => {
    // Where the eye is: the middle of what is in sight.
    if (!shown) place = stage.zoom.placeAt(stage.zoom.middle());
    shown = true;
    stage.node.classList.add("sw-crossing");
    parts.draw();
    parts.point(place);
  };
  const go = () => {
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

  /** @param {Point} way @param {KeyboardEvent} event */
  const walk = ([dx, dy], event) => {
    const step = event.altKey ? 1 : STEP * (event.shiftKey ? 10 : 1);
    const box = stage.rectangle();
    const held = (/** @type {number} */ at) => Math.min(1, Math.max(0, at));
    place = [held(place[0] + (dx * step) / box.width), held(place[1] + (dy * step) / box.height)];
    moved = true;
    if (pressed) tool().move(place, as(event));
    else tool().hover?.(place);
    stage.zoom.bring(place);
    parts.draw();
    parts.point(place);
    tell();
  };

  const tell = () => {
    const { camera } = picture;
    if (!camera) return;
    const [x, y] = [place[0] * camera.width, place[1] * camera.height];
    announcer.say(`Cross at ${directionText(...camera.angles(x, y))}`, "cross");
  };

  /** Space is the hand of somebody with a mouse, who has no cross. @param {KeyboardEvent} event */
  const isPress = ({ key }) => key === "Enter" || (key === " " && shown);

  /** @param {KeyboardEvent} event */
  const press = (event) => {
    if (pressed) return release();
    if (!picture.scene || hand.pointer !== null) return;
    pressed = true;
    moved = false;
    tool().begin(place, as(event));
  };

  /** @param {KeyboardEvent} event */
  const onKey = (event) => {
    if (event.target !== stage.node || event.ctrlKey || event.metaKey) return;
    const way = WAYS[event.key];
    if (way) {
      come();
      walk(way, event);
    } else if (isPress(event)) {
      come();
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
    if (!stage.focusing) come();
  });
  on("blur", go);
  on("pointerdown", go);
  on("pointermove", (event) => {
    // A mouse that rests is told of a move, too, when the picture moves under it.
    if (event.movementX || event.movementY) go();
  });

  return {
    draw() {
      const [x, y] = stage.onOverlay(place);
      setAttributes(node, { transform: `translate(${x} ${y})` });
      // A tool that was chosen in the meantime stands here, too.
      if (shown && !pressed) tool().hover?.(place);
    },
  };
}
