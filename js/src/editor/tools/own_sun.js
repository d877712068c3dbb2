/**
 * A faint ring where the photo's sun was found. Pointing at it, or reaching it with Tab, opens a
 * label with the confidence and actions to reject or move it.
 */

import { equal } from "../../edit/equality.js";
import { element, setAttributes, shape } from "../../ui/element.js";
import { markText } from "../../ui/sun_words.js";
import { selectTool, setSunOutside } from "../view/notes.js";

/** @typedef {import("../../host/types.js").Point} Point */

const RADIUS = 20; // CSS pixels: around the sun's handle, which starts there
const NEAR = 24; // CSS pixels from its center within which the pointer means it
const COVERED = 30; // CSS pixels from the handle within which a press belongs to the handle
const TAP = 5; // CSS pixels that a finger may slip
const MARGIN = 6; // CSS pixels between the label and the stage's edge
const OPEN_MS = 350;
const CLOSE_MS = 400; // time to move from the ring to its label

/**
 * @type {import("../types.js").MakePart<"hand" | "kernel" | "picture" | "root" | "stage"
 *   | "state">}
 */
export function ownSun({ hand, kernel, picture, root, stage, state }, signal) {
  const ring = element("button", {
    type: "button",
    class: "sw-own-sun-ring",
    "aria-expanded": "false",
  });
  const circle = (/** @type {string} */ name) => shape("circle", { class: name, r: RADIUS - 1 });
  ring.append(
    shape(
      "svg",
      { viewBox: `${-RADIUS} ${-RADIUS} ${2 * RADIUS} ${2 * RADIUS}`, "aria-hidden": "true" },
      circle("sw-own-sun-shadow"),
      circle("sw-own-sun-line"),
    ),
  );
  const text = element("span");
  const action = (/** @type {string} */ label, /** @type {(event: MouseEvent) => void} */ run) => {
    const act = element("button", { type: "button", class: "sw-stage-action" }, label);
    act.addEventListener("click", (event) => {
      setOpen(false);
      run(event);
    });
    return act;
  };
  const actions = element(
    "span",
    { class: "sw-own-sun-actions" },
    action("Not the sun", () => setSunOutside({ stage, state })),
    action("Move this mark", (event) => selectTool({ hand, stage }, "pick", event)),
  );
  const label = element("div", { class: "sw-own-sun-label", hidden: true }, text, actions);
  const node = element("div", { class: "sw-own-sun", hidden: true }, ring, label);
  stage.overlay.after(node);

  /** @type {unknown} the edit's sun hint that the scene reflects */
  let followed;
  /** @type {Point | null} position on the overlay in CSS pixels; null while hidden */
  let at = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  signal.addEventListener("abort", () => clearTimeout(timer));

  /** @param {boolean} open */
  const setOpen = (open) => {
    clearTimeout(timer);
    timer = undefined;
    label.hidden = !open;
    ring.setAttribute("aria-expanded", String(open));
    node.classList.toggle("sw-open", open);
    if (open) place();
  };
  /** Open or close it after a delay, unless the pointer returns meanwhile. @param {boolean} open */
  const setOpenLater = (open) => {
    if (open === !label.hidden) {
      clearTimeout(timer);
      timer = undefined;
    } else timer ??= setTimeout(() => setOpen(open), open ? OPEN_MS : CLOSE_MS);
  };

  /** Place the label beside the ring, else below or above it, where it covers neither ring nor handle. */
  const place = () => {
    if (!at || label.hidden) return;
    const [x, y] = at;
    const { stageWidth, stageHeight } = stage.rectangle();
    const { offsetWidth: width, offsetHeight: height } = label;
    const within = (/** @type {number} */ start, /** @type {number} */ room) =>
      Math.max(MARGIN, Math.min(start, room - MARGIN));
    const apart = RADIUS + MARGIN;
    const spots = [
      [x + apart, y - height / 2],
      [x - apart - width, y - height / 2],
      [x + apart, y + apart],
      [x + apart, y - apart - height],
    ].map(([left, top]) => [within(left, stageWidth - width), within(top, stageHeight - height)]);
    /** @type {(spot: number[], point: { x: number, y: number }) => boolean} */
    const clearOf = ([left, top], point) =>
      Math.abs(point.x - left - width / 2) >= width / 2 + RADIUS ||
      Math.abs(point.y - top - height / 2) >= height / 2 + RADIUS;
    const clear = spots.filter((spot) => clearOf(spot, { x, y }));
    const handle = hand.tools.sun.spot?.();
    const best = clear.find((spot) => !handle || clearOf(spot, handle));
    const [left, top] = best ?? clear[0] ?? spots[0];
    label.style.transform = `translate(${left}px, ${top}px)`;
  };

  /** The mark's current position, or null if it is hidden. @returns {Point | null} */
  const find = () => {
    const sun = picture.scene?.sun;
    const usable = hand.tool === "sun" || hand.tool === "pick";
    const still = state.before === null && hand.pointer === null && picture.passing === null;
    // A newer hint about the sun takes precedence over the detection.
    const current = equal(state.values.sun_hint ?? null, followed);
    if (!sun?.at || !usable || !still || !current) return null;
    const { stageWidth, stageHeight } = stage.rectangle();
    const [x, y] = stage.onOverlay(sun.at);
    return x > 0 && y > 0 && x < stageWidth && y < stageHeight ? [x, y] : null;
  };

  const draw = () => {
    at = find();
    node.hidden = at === null;
    if (!at || !picture.scene) return setOpen(false);
    const { sun } = picture.scene;
    const words = markText(sun);
    if (text.textContent !== words) text.textContent = words;
    setAttributes(ring, { "aria-label": words });
    actions.hidden = !kernel.answers;
    ring.style.transform = `translate(${at[0] - RADIUS}px, ${at[1] - RADIUS}px)`;
    const handle = hand.tools.sun.spot?.();
    const apart = handle ? Math.hypot(handle.x - at[0], handle.y - at[1]) : 0;
    node.classList.toggle("sw-covered", apart < COVERED);
    place();
  };

  /** @param {Point} place a place of the picture */
  const isNear = (place) => {
    const [x, y] = stage.onOverlay(place);
    return at !== null && Math.hypot(x - at[0], y - at[1]) < NEAR;
  };

  /** @type {(target: EventTarget, name: string, listener: (event: any) => void) => void} */
  const on = (target, name, listener) => target.addEventListener(name, listener, { signal });
  on(node, "pointerenter", () => setOpenLater(true));
  on(node, "pointerleave", () => setOpenLater(node.contains(focused())));
  on(node, "focusin", () => setOpen(true));
  on(node, "focusout", (event) => {
    if (!node.contains(event.relatedTarget)) setOpen(false);
  });
  on(ring, "click", () => setOpen(true));
  on(node, "keydown", (event) => {
    if (event.key !== "Escape" || label.hidden) return;
    event.stopPropagation();
    ring.focus();
    setOpen(false);
  });
  // Fingers do not hover: a tap on the sun without a drag opens the label.
  /** @type {{ clientX: number, clientY: number }} */
  let down = { clientX: 0, clientY: 0 };
  on(stage.overlay, "pointerdown", (event) => {
    down = event;
    setOpen(false);
  });
  on(stage.overlay, "pointerup", (event) => {
    const slip = Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY);
    if (event.pointerType === "mouse" || slip > TAP || hand.tool !== "sun") return;
    requestAnimationFrame(() => {
      draw();
      if (isNear(stage.placeOf(event))) setOpen(true);
    });
  });
  const focused = () => /** @type {Document | ShadowRoot} */ (root.getRootNode()).activeElement;

  return {
    loaded() {
      followed = state.values.sun_hint ?? null;
    },
    show: draw,
    draw,
    point(place) {
      if (hand.pointer !== null) return;
      setOpenLater(
        place !== null && hand.tool === "sun" ? isNear(place) : node.contains(focused()),
      );
    },
  };
}
