/**
 * Pointers on the stage: one drags with the chosen tool or hovers; the middle button, or any with
 * the space bar held, shifts the picture; two fingers shift and zoom it.
 */

/**
 * @typedef {import("../../host/types.js").Point} Point
 * @typedef {{ clientX: number, clientY: number }} Spot
 */

const SLOP = 5; // CSS pixels that a finger may move before it means a drag
const HESITATION = 120; // ms after which a finger that rests means one too

/**
 * @param {import("../types.js").Needs<"hand" | "parts" | "picture" | "root" | "stage">} needs
 * @param {AbortSignal} signal
 * @returns {() => void} drops what a pointer has begun, and lets it go
 */
export function listenToPointer({ hand, parts, picture, root, stage }, signal) {
  const { overlay } = stage;
  const tool = () => hand.tools[hand.tool];
  /** @type {Map<number, Spot>} */
  const fingers = new Map();
  let pinching = false; // until the last finger is lifted
  /** @type {{ place: Point, size: number, scale: number }} what the fingers hold */
  let grip = { place: [0, 0], size: 0, scale: 1 };
  let panning = false;
  /** @type {Spot} where a pointer that pans was last */
  let last = { clientX: 0, clientY: 0 };
  /** @type {PointerEvent | null} a finger that may be the first of two */
  let waiting = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;

  const begin = () => {
    clearTimeout(timer);
    const event = waiting;
    waiting = null;
    if (event) tool().begin(stage.placeOf(event), event);
  };

  const hold = () => {
    const { size, ...middle } = span([...fingers.values()]);
    grip = { place: stage.placeOf(middle), size, scale: stage.zoom.scale };
  };

  /** A second finger: what the first began was not meant. */
  const pinch = () => {
    clearTimeout(timer);
    if (hand.pointer !== null && !waiting && !panning) tool().cancel();
    waiting = null;
    hand.pointer = null;
    panning = false;
    pinching = true;
  };

  /** @param {PointerEvent} event */
  const down = (event) => {
    const touch = event.pointerType === "touch";
    if (touch) fingers.set(event.pointerId, at(event));
    if (touch && fingers.size === 2) pinch();
    if (pinching) {
      overlay.setPointerCapture(event.pointerId);
      hold();
    }
    if (pinching || hand.pointer !== null || event.button > 1) return;
    panning = event.button === 1 || root.classList.contains("sw-hand");
    if (!panning && !picture.scene) return;
    hand.pointer = event.pointerId;
    overlay.setPointerCapture(hand.pointer);
    event.preventDefault();
    stage.focus();
    last = at(event);
    if (panning) return;
    waiting = event;
    if (touch) timer = setTimeout(begin, HESITATION);
    else begin();
  };

  /** @param {PointerEvent} event */
  const move = (event) => {
    if (pinching) return stretch(event);
    const place = stage.placeOf(event);
    parts.point(place);
    if (hand.pointer === null) tool().hover?.(place);
    else if (event.pointerId !== hand.pointer) return;
    else if (panning) {
      stage.pan(event.clientX - last.clientX, event.clientY - last.clientY);
      last = at(event);
    } else {
      if (waiting && apart(waiting, event) < SLOP) return;
      begin();
      const passed = tool().fine ? (event.getCoalescedEvents?.() ?? []) : [];
      for (const each of passed.length ? passed : [event]) {
        tool().move(stage.placeOf(each), each);
      }
    }
  };

  /** @param {PointerEvent} event */
  const stretch = (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, at(event));
    const { size, ...middle } = span([...fingers.values()]);
    stage.hold(grip.place, middle, grip.scale * (grip.size ? size / grip.size : 1));
  };

  // The end of capture is the one end of a drag, whatever ended it.
  /** @param {PointerEvent} event */
  const lost = (event) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) pinching = false;
    else if (pinching) hold();
    if (event.pointerId !== hand.pointer) return;
    begin();
    hand.pointer = null;
    if (!panning) tool().end();
    panning = false;
  };
  const cancel = () => {
    const { pointer } = hand;
    clearTimeout(timer);
    waiting = null;
    panning = false;
    hand.pointer = null; // so that the end of its capture ends nothing of the next tool's
    tool().cancel();
    if (pointer !== null && overlay.hasPointerCapture(pointer)) {
      overlay.releasePointerCapture(pointer);
    }
  };
  const leave = () => {
    parts.point(null);
    if (hand.pointer === null) tool().hover?.(null);
  };
  overlay.addEventListener("pointerdown", down, { signal });
  overlay.addEventListener("pointermove", move, { signal });
  overlay.addEventListener("lostpointercapture", lost, { signal });
  overlay.addEventListener("pointerleave", leave, { signal });
  overlay.addEventListener("pointercancel", cancel, { signal });
  overlay.addEventListener("dblclick", () => tool().reset?.(), { signal });
  // The focus is where `down` or the tool has put it.
  overlay.addEventListener("mousedown", (event) => event.preventDefault(), { signal });
  signal.addEventListener("abort", () => clearTimeout(timer));
  return cancel;
}

/** @param {Spot} event @returns {Spot} */
const at = ({ clientX, clientY }) => ({ clientX, clientY });

/** @param {Spot} a @param {Spot} b */
const apart = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);

/** The middle of one or two fingers, and how far apart these are. @param {Spot[]} fingers */
function span([a, b = a]) {
  return {
    clientX: (a.clientX + b.clientX) / 2,
    clientY: (a.clientY + b.clientY) / 2,
    size: apart(a, b),
  };
}
