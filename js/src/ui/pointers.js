/**
 * Pointers on a stage: one drags with a tool. Where the picture can be zoomed, the middle button,
 * or any with the space bar held, shifts it; two fingers shift and zoom it; Ctrl or Cmd and the
 * wheel zoom it.
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
 * }} DragTool what a pointer drags with; a `fine` one is told of every point on the way
 * @typedef {{
 *   tool: () => DragTool,
 *   ready?: () => boolean,
 *   zoom?: import("../geometry/zoom.js").Zoom,
 *   onTake?: (pointer: number | null) => void,
 *   onPoint?: (place: Point | null, free: boolean) => void,
 * }} Options `ready` tells whether the tool can be used yet; `onTake` hears which pointer drags or
 *   shifts the picture, or none; `onPoint` hears where a pointer is, whether it is free or drags
 */

const WHEEL = 0.002; // what a CSS pixel of the wheel zooms by, as a logarithm
const PINCH = 0.01; // and of two fingers on a touchpad, which sends smaller steps
const WHEEL_NOTCH = 50; // CSS pixels: a wheel sends more at once, two fingers less
const LARGEST_NOTCH = 200; // CSS pixels
const LINE = 33; // CSS pixels to a line, which some browsers count in
const SLOP = 5; // CSS pixels that a finger may move before it means a drag
const HESITATION = 120; // ms after which a finger that rests means one too

/**
 * @param {import("./stage.js").PictureStage} stage
 * @param {Options} options
 * @param {AbortSignal} signal
 * @returns {() => void} drops what a pointer has begun, and lets it go
 */
export function listenToPointers(stage, { tool, ready, zoom, onTake, onPoint }, signal) {
  const { overlay } = stage;
  /** @type {number | null} the pointer that drags or shifts the picture */
  let pointer = null;
  let panning = false;
  /** @type {Spot} where a pointer that shifts the picture was last */
  let last = { clientX: 0, clientY: 0 };
  /** @type {PointerEvent | null} a finger that may be the first of two */
  let waiting = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  /** @type {Map<number, Spot>} */
  const fingers = new Map();
  let pinching = false; // until the last finger is lifted
  /** @type {{ place: Point, size: number, scale: number }} what the fingers hold */
  let grip = { place: [0, 0], size: 0, scale: 1 };

  /** @param {number | null} which */
  const take = (which) => {
    pointer = which;
    onTake?.(which);
  };

  /** No finger is waited for any longer; returns the one that was. */
  const forget = () => {
    clearTimeout(timer);
    const event = waiting;
    waiting = null;
    return event;
  };

  const begin = () => {
    const event = forget();
    if (event) tool().begin(stage.placeOf(event), event);
  };

  /** @param {Spot | null} spot */
  const tell = (spot) => onPoint?.(spot && stage.placeOf(spot), pointer === null);

  const hold = () => {
    const { size, ...middle } = span([...fingers.values()]);
    grip = { place: stage.placeOf(middle), size, scale: zoom?.scale ?? 1 };
  };

  /** A second finger: what the first began was not meant. */
  const pinch = () => {
    if (!forget() && pointer !== null && !panning) tool().cancel();
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
    tell(event);
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

  // The end of capture is the one end of a drag, whatever ended it.
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
    forget();
    panning = false;
    take(null); // so that the end of its capture ends nothing of the next tool's
    tool().cancel();
    if (begun !== null && overlay.hasPointerCapture(begun)) overlay.releasePointerCapture(begun);
  };

  overlay.addEventListener("pointerdown", down, { signal });
  overlay.addEventListener("pointermove", move, { signal });
  overlay.addEventListener("lostpointercapture", lost, { signal });
  overlay.addEventListener("pointercancel", cancel, { signal });
  overlay.addEventListener("pointerleave", () => tell(null), { signal });
  signal.addEventListener("abort", () => clearTimeout(timer));
  if (zoom) listenToWheel(stage, zoom, signal);
  return cancel;
}

/**
 * Plain wheel scrolls the page; with Ctrl or Cmd it zooms about the pointer, and so it does where
 * nothing else can be meant: in full screen, and while the keyboard's cross is on the picture.
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

/** What a wheel, or two fingers on a touchpad, zoom by, as a logarithm. @param {WheelEvent} event */
export function wheelZoom({ deltaY, deltaMode, ctrlKey }) {
  const pixels = deltaY * (deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : LINE);
  const pinch = ctrlKey && Math.abs(pixels) < WHEEL_NOTCH;
  return -Math.min(LARGEST_NOTCH, Math.max(-LARGEST_NOTCH, pixels)) * (pinch ? PINCH : WHEEL);
}

/** @param {Spot} event @returns {Spot} */
const spotOf = ({ clientX, clientY }) => ({ clientX, clientY });

/** @param {Spot} a @param {Spot} b */
const apart = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);

/** The middle of one or two fingers, and how far apart these are. @param {Spot[]} fingers */
const span = ([a, b = a]) => ({
  clientX: (a.clientX + b.clientX) / 2,
  clientY: (a.clientY + b.clientY) / 2,
  size: apart(a, b),
});
