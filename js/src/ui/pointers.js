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
 *   zoom?: import("../geometry/zoom.js").Zoom | null,
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

export class Pointers {
  /**
   * @param {import("./stage.js").PictureStage} stage
   * @param {Options} options
   * @param {AbortSignal} signal
   */
  constructor(stage, { tool, ready, zoom = null, onTake, onPoint }, signal) {
    this.stage = stage;
    this.tool = tool;
    this.ready = ready;
    this.zoom = zoom;
    this.onTake = onTake;
    this.onPoint = onPoint;
    /** @type {number | null} the pointer that drags or shifts the picture */
    this.pointer = null;
    this.panning = false;
    /** @type {Spot} where a pointer that shifts the picture was last */
    this.last = { clientX: 0, clientY: 0 };
    /** @type {PointerEvent | null} a finger that may be the first of two */
    this.waiting = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    /** @type {Map<number, Spot>} */
    this.fingers = new Map();
    this.pinching = false; // until the last finger is lifted
    /** @type {{ place: Point, size: number, scale: number }} what the fingers hold */
    this.grip = { place: [0, 0], size: 0, scale: 1 };
    const { overlay } = stage;
    overlay.addEventListener("pointerdown", (event) => this.down(event), { signal });
    overlay.addEventListener("pointermove", (event) => this.move(event), { signal });
    // The end of capture is the one end of a drag, whatever ended it.
    overlay.addEventListener("lostpointercapture", (event) => this.lost(event), { signal });
    overlay.addEventListener("pointercancel", () => this.cancel(), { signal });
    overlay.addEventListener("pointerleave", () => this.tell(null), { signal });
    signal.addEventListener("abort", () => clearTimeout(this.timer));
    if (zoom) onWheel(stage, zoom, signal);
  }

  /** @param {PointerEvent} event */
  down(event) {
    const { zoom } = this;
    const touch = zoom !== null && event.pointerType === "touch";
    if (touch) this.fingers.set(event.pointerId, spotOf(event));
    if (touch && this.fingers.size === 2) this.pinch();
    if (this.pinching) {
      this.stage.overlay.setPointerCapture(event.pointerId);
      this.hold();
    }
    if (this.pinching || this.pointer !== null || event.button > (zoom ? 1 : 0)) return;
    const hand = event.button === 1 || this.stage.node.closest(".sw-hand") !== null;
    this.panning = zoom !== null && hand;
    if (!this.panning && this.ready?.() === false) return;
    this.stage.overlay.setPointerCapture(event.pointerId);
    event.preventDefault();
    this.take(event.pointerId);
    this.last = spotOf(event);
    if (this.panning) return;
    this.waiting = event;
    if (touch) this.timer = setTimeout(() => this.begin(), HESITATION);
    else this.begin();
  }

  /** @param {number | null} pointer */
  take(pointer) {
    this.pointer = pointer;
    this.onTake?.(pointer);
  }

  begin() {
    const event = this.forget();
    if (event) this.tool().begin(this.stage.placeOf(event), event);
  }

  /** No finger is waited for any longer. Returns the one that was. */
  forget() {
    clearTimeout(this.timer);
    const event = this.waiting;
    this.waiting = null;
    return event;
  }

  /** @param {Spot | null} spot */
  tell(spot) {
    this.onPoint?.(spot && this.stage.placeOf(spot), this.pointer === null);
  }

  /** @param {PointerEvent} event */
  move(event) {
    if (this.pinching) return this.stretch(event);
    this.tell(event);
    if (event.pointerId !== this.pointer) return;
    if (this.panning) {
      this.zoom?.pan(event.clientX - this.last.clientX, event.clientY - this.last.clientY);
      this.last = spotOf(event);
    } else {
      if (this.waiting && apart(this.waiting, event) < SLOP) return;
      this.begin();
      const tool = this.tool();
      const passed = tool.fine ? (event.getCoalescedEvents?.() ?? []) : [];
      for (const each of passed.length ? passed : [event]) {
        tool.move(this.stage.placeOf(each), each);
      }
    }
  }

  /** A second finger: what the first began was not meant. */
  pinch() {
    if (!this.forget() && this.pointer !== null && !this.panning) this.tool().cancel();
    this.take(null);
    this.panning = false;
    this.pinching = true;
  }

  hold() {
    const { size, ...middle } = span([...this.fingers.values()]);
    this.grip = { place: this.stage.placeOf(middle), size, scale: this.zoom?.scale ?? 1 };
  }

  /** @param {PointerEvent} event */
  stretch(event) {
    if (!this.fingers.has(event.pointerId)) return;
    this.fingers.set(event.pointerId, spotOf(event));
    const { size, ...middle } = span([...this.fingers.values()]);
    const { place, scale, size: before } = this.grip;
    this.zoom?.hold(place, this.stage.pointOf(middle), scale * (before ? size / before : 1));
  }

  /** @param {PointerEvent} event */
  lost(event) {
    this.fingers.delete(event.pointerId);
    if (!this.fingers.size) this.pinching = false;
    else if (this.pinching) this.hold();
    if (event.pointerId !== this.pointer) return;
    this.begin();
    this.take(null);
    if (!this.panning) this.tool().end();
    this.panning = false;
  }

  /** Drop what a pointer has begun, and let it go. */
  cancel() {
    const { pointer } = this;
    const { overlay } = this.stage;
    this.forget();
    this.panning = false;
    this.take(null); // so that the end of its capture ends nothing of the next tool's
    this.tool().cancel();
    if (pointer !== null && overlay.hasPointerCapture(pointer)) {
      overlay.releasePointerCapture(pointer);
    }
  }
}

/**
 * Plain wheel scrolls the page; with Ctrl or Cmd it zooms about the pointer, and so it does where
 * nothing else can be meant: in full screen, and while the keyboard's cross is on the picture.
 *
 * @param {import("./stage.js").PictureStage} stage
 * @param {import("../geometry/zoom.js").Zoom} zoom
 * @param {AbortSignal} signal
 */
function onWheel(stage, zoom, signal) {
  const turned = (/** @type {WheelEvent} */ event) => {
    const alone = stage.node.matches(".sw-crossing, .sw-full *");
    if (!alone && !event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    zoom.zoomTo(zoom.scale * Math.exp(wheelZoom(event)), stage.pointOf(event));
  };
  stage.node.addEventListener("wheel", turned, { passive: false, signal });
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
