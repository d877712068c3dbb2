/**
 * Pointers on a stage: one drags with a tool. In a zoomable picture the middle button, or any button
 * with the space bar held, pans; two fingers pan and zoom; Ctrl or Cmd with the wheel zooms.
 */

/**
 * @typedef {import("../host/types.js").Point} Point
 * @typedef {import("./stage.js").Spot} Spot
 * @typedef {{
 *   begin: (place: Point, event: PointerEvent) => void,
 *   move: (place: Point, event: PointerEvent) => void,
 *   end: () => void,
 *   cancel: () => void,
 *   fine?: boolean,
 * }} DragTool what a pointer drags with; a `fine` one receives every intermediate point
 * @typedef {{
 *   tool: () => DragTool,
 *   ready?: () => boolean,
 *   zoom?: import("../geometry/zoom.js").Zoom,
 *   onTake?: (pointer: number | null) => void,
 *   onPoint?: (place: Point | null, free: boolean) => void,
 * }} Options `ready` returns whether the tool can be used yet; `onTake` receives the pointer that
 *   drags or pans, or null; `onPoint` receives a pointer's place and whether it is free
 */

const WHEEL = 0.002; // logarithm of the zoom per CSS pixel of the wheel
const PINCH = 0.01; // the same for two fingers on a touchpad, which sends smaller steps
const WHEEL_NOTCH = 50; // CSS pixels: a wheel sends more at once, a touchpad less
const LARGEST_NOTCH = 200; // CSS pixels
const LINE = 33; // CSS pixels per line, the unit of some browsers
const SLOP = 5; // CSS pixels that a finger may move before a drag starts
const HESITATION = 120; // ms after which a resting finger also starts one

/**
 * @param {import("./stage.js").PictureStage} stage
 * @param {Options} options
 * @param {AbortSignal} signal
 * @returns {() => void} cancels the pointer's gesture and releases it
 */
export function listenToPointers(stage, { tool, ready, zoom, onTake, onPoint }, signal) {
  const { overlay } = stage;
  /** @type {number | null} the pointer that drags or pans */
  let pointer = null;
  let panning = false;
  /** @type {Spot} last position of a panning pointer */
  let last = { clientX: 0, clientY: 0 };
  /** @type {PointerEvent | null} a finger that may be the first of two */
  let waiting = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  /** @type {Map<number, Spot>} */
  const fingers = new Map();
  let pinching = false; // until the last finger is lifted
  /** @type {{ place: Point, size: number, scale: number }} what two fingers hold */
  let grip = { place: [0, 0], size: 0, scale: 1 };

  /** @param {number | null} which */
  const take = (which) => {
    pointer = which;
    onTake?.(which);
  };

  /** Stop waiting for a second finger; returns the first one. */
  const stopWaiting = () => {
    clearTimeout(timer);
    const event = waiting;
    waiting = null;
    return event;
  };

  const begin = () => {
    const event = stopWaiting();
    if (event) tool().begin(stage.placeOf(event), event);
  };

  /** @param {Spot | null} spot */
  const report = (spot) => onPoint?.(spot && stage.placeOf(spot), pointer === null);

  const hold = () => {
    const { size, ...middle } = span([...fingers.values()]);
    grip = { place: stage.placeOf(middle), size, scale: zoom?.scale ?? 1 };
  };

  /** Handle a second finger: cancel what the first one started. */
  const pinch = () => {
    if (!stopWaiting() && pointer !== null && !panning) tool().cancel();
    take(null);
    panning = false;
    pinching = true;
  };

  /** @param {PointerEvent} event */
  const down = (event) => {
    const touch = zoom && event.pointerType === "touch";
    if (touch) fingers.set(event.pointerId, spotOf(event));
    if (touch && fingers.size === 2) pinch();
    if (pinching) {
      overlay.setPointerCapture(event.pointerId);
      hold();
    }
    if (pinching || pointer !== null || event.button > (zoom ? 1 : 0)) return;
    panning = Boolean(zoom && (event.button === 1 || overlay.closest(".sw-hand")));
    if (!panning && ready?.() === false) return;
    overlay.setPointerCapture(event.pointerId);
    event.preventDefault();
    take(event.pointerId);
    last = spotOf(event);
    if (panning) return;
    waiting = event;
    if (touch) timer = setTimeout(begin, HESITATION);
    else begin();
  };

  /** @param {PointerEvent} event */
  const move = (event) => {
    if (pinching) return stretch(event);
    report(event);
    if (event.pointerId !== pointer) return;
    if (panning) {
      zoom?.pan(event.clientX - last.clientX, event.clientY - last.clientY);
      last = spotOf(event);
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
    fingers.set(event.pointerId, spotOf(event));
    const { size, ...middle } = span([...fingers.values()]);
    const scale = grip.scale * (grip.size ? size / grip.size : 1);
    zoom?.hold(grip.place, stage.pointOf(middle), scale);
  };

  // Every drag ends with lostpointercapture, whatever its cause.
  /** @param {PointerEvent} event */
  const lost = (event) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) pinching = false;
    else if (pinching) hold();
    if (event.pointerId !== pointer) return;
    begin();
    take(null);
    if (!panning) tool().end();
    panning = false;
  };

  const cancel = () => {
    const begun = pointer;
    stopWaiting();
    panning = false;
    take(null); // so that lostpointercapture does not end the next tool's gesture
    tool().cancel();
    if (begun !== null && overlay.hasPointerCapture(begun)) overlay.releasePointerCapture(begun);
  };

  overlay.addEventListener("pointerdown", down, { signal });
  overlay.addEventListener("pointermove", move, { signal });
  overlay.addEventListener("lostpointercapture", lost, { signal });
  overlay.addEventListener("pointercancel", cancel, { signal });
  overlay.addEventListener("pointerleave", () => report(null), { signal });
  signal.addEventListener("abort", () => clearTimeout(timer));
  if (zoom) listenToWheel(stage, zoom, signal);
  return cancel;
}

/**
 * The plain wheel scrolls the page; with Ctrl or Cmd it zooms about the pointer. In full screen and
 * while the keyboard's cross is shown, it always zooms.
 *
 * @param {import("./stage.js").PictureStage} stage
 * @param {import("../geometry/zoom.js").Zoom} zoom
 * @param {AbortSignal} signal
 */
function listenToWheel(stage, zoom, signal) {
  const wheel = (/** @type {WheelEvent} */ event) => {
    const alone = stage.node.matches(".sw-crossing, .sw-full *");
    if (!alone && !event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    zoom.zoomTo(zoom.scale * Math.exp(wheelZoom(event)), stage.pointOf(event));
  };
  stage.node.addEventListener("wheel", wheel, { passive: false, signal });
}

/** Return the logarithm of the zoom by a wheel or touchpad. @param {WheelEvent} event */
export function wheelZoom({ deltaY, deltaMode, ctrlKey }) {
  const pixels = deltaY * (deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : LINE);
  const pinch = ctrlKey && Math.abs(pixels) < WHEEL_NOTCH;
  return -Math.min(LARGEST_NOTCH, Math.max(-LARGEST_NOTCH, pixels)) * (pinch ? PINCH : WHEEL);
}

/** @param {Spot} event @returns {Spot} */
const spotOf = ({ clientX, clientY }) => ({ clientX, clientY });

/** @param {Spot} a @param {Spot} b */
const apart = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);

/** Return the middle of one or two fingers, and their distance. @param {Spot[]} fingers */
const span = ([a, b = a]) => ({
  clientX: (a.clientX + b.clientX) / 2,
  clientY: (a.clientY + b.clientY) / 2,
  size: apart(a, b),
});
