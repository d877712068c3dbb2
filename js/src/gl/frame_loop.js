/**
 * Schedules a view's drawing: at most once per screen refresh, only while visible, smaller during a
 * drag on a slow machine, and in full once the gesture rests. The first frame of a scene, which
 * also draws everything that is cached, is no larger than visible either.
 */

const SLOW_MS = 33; // a frame that waits longer makes the next ones smaller
const FAST_MS = 18; // about the wait for the screen's next refresh
// Scales of a drag. Few, since a new size redraws all of the picture's passes.
const SCALES = [1, 0.84, 0.71, 0.59, 0.5, 0.42, 0.35];
// Frames after a new size that are not timed: the first fills the caches, the second waits for it.
const UNTIMED_FRAMES = 2;
const SETTLED_MS = 160; // without a change, after which the frame is drawn in full

export class FrameLoop {
  /**
   * @param {(scale: number) => void} draw draws at a share of the full size
   * @param {() => boolean} dragging whether a gesture is in progress
   * @param {AbortSignal} signal
   */
  constructor(draw, dragging, signal) {
    this.draw = draw;
    this.dragging = dragging;
    this.signal = signal;
    this.visible = true;
    this.owed = false; // a frame was requested while not visible
    /** @type {() => number} the largest visible scale during a drag */
    this.limit = () => 1;
    this.first = false; // whether the first frame of a scene is pending
    this.wanted = 1; // the largest scale that is fast enough
    this.scale = 1; // of the last frame
    this.untimed = UNTIMED_FRAMES; // how many frames are still not timed
    this.pending = 0;
    this.asked = 0; // when the current frame was requested, ms
    this.spent = 0; // from the request of the last frame until it was drawn, ms
    this.rests = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.settle = undefined;
    signal.addEventListener("abort", () => {
      cancelAnimationFrame(this.pending);
      clearTimeout(this.settle);
    });
  }

  /** Whether a frame is still to come. */
  get busy() {
    return this.pending !== 0 || this.settle !== undefined;
  }

  /** Draw with the next refresh. */
  request() {
    this.rests = false;
    this.schedule();
  }

  /** Set whether the view is visible; an owed frame is drawn when it becomes visible. @param {boolean} visible */
  setVisible(visible) {
    this.visible = visible;
    if (visible && this.owed) this.schedule();
  }

  schedule() {
    this.owed = !this.visible;
    if (this.owed || this.pending || this.signal.aborted) return;
    this.asked = performance.now();
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.run();
    });
  }

  run() {
    const { asked } = this;
    const asSeen = this.first && this.limit() < 1;
    const small = (this.dragging() || asSeen) && !this.rests;
    this.first = false;
    const scale = small ? Math.min(floorScale(this.wanted), this.limit()) : 1;
    if (scale !== this.scale) this.untimed = UNTIMED_FRAMES;
    this.scale = scale;
    clearTimeout(this.settle);
    // On a slow machine pointer moves also arrive late.
    this.settle = small ? setTimeout(() => this.finish(), SETTLED_MS + 2 * this.spent) : undefined;
    this.draw(scale);
    // A slow machine delays the frame or its drawing; a slow gesture delays neither.
    this.spent = performance.now() - asked;
    if (this.untimed > 0) this.untimed -= 1;
    else if (small) this.adapt(this.spent);
  }

  /** Draw in full once the gesture rests. */
  finish() {
    this.settle = undefined;
    this.rests = true;
    this.schedule();
  }

  /** @param {number} spent ms */
  adapt(spent) {
    if (spent > SLOW_MS) {
      // One slow frame may be an accident: at most half the size at once.
      this.wanted = this.scale * Math.max(0.5, Math.sqrt(SLOW_MS / spent));
    } else if (spent < FAST_MS) {
      this.wanted = Math.min(1, this.wanted * 1.01);
    }
  }
}

/** Return the largest of `SCALES` that does not exceed the wanted one. @param {number} wanted */
const floorScale = (wanted) => SCALES.find((scale) => scale <= wanted) ?? SCALES[SCALES.length - 1];
