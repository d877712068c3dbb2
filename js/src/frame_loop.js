/**
 * When a view draws: once a refresh of the screen at most, smaller while a drag lasts and the
 * machine is behind, and in full as soon as the hand rests.
 */

const SLOW_MS = 33; // a frame that waits longer makes the next ones smaller
const FAST_MS = 18; // waiting for the screen's next refresh takes as long
// Sizes that a drag may take. Few, since with a new size all of the picture's passes are drawn again.
const SCALES = [1, 0.84, 0.71, 0.59, 0.5, 0.42, 0.35];
const SETTLED_MS = 160; // after this long without a change the frame is drawn in full

export class FrameLoop {
  /**
   * @param {(scale: number) => void} draw draws at a share of the full size
   * @param {() => boolean} dragging whether a gesture is under way
   * @param {AbortSignal} signal
   */
  constructor(draw, dragging, signal) {
    this.draw = draw;
    this.dragging = dragging;
    this.wanted = 1; // the scale that would be just fast enough
    this.scale = 1; // the last one that was drawn
    this.resized = true; // whether the last frame had another size than the one before
    this.pending = 0;
    this.asked = 0; // when the frame under way was asked for, ms
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

  /** Something changed: draw with the next refresh. */
  request() {
    this.rests = false;
    this.schedule();
  }

  schedule() {
    if (this.pending) return;
    this.asked = performance.now();
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.run();
    });
  }

  run() {
    const small = this.dragging() && !this.rests;
    clearTimeout(this.settle);
    this.settle = undefined;
    if (small) {
      // A machine that is behind lets a frame wait; a slow hand does not. The frame after a new
      // size waits for what is drawn only once.
      if (!this.resized) this.adapt(performance.now() - this.asked);
      this.settle = setTimeout(() => {
        this.settle = undefined;
        this.rests = true;
        this.schedule();
      }, SETTLED_MS);
    }
    const scale = small ? rung(this.wanted) : 1;
    this.resized = scale !== this.scale;
    this.scale = scale;
    this.draw(scale);
  }

  /** @param {number} waited ms */
  adapt(waited) {
    if (waited > SLOW_MS) {
      const enough = this.scale * Math.sqrt(SLOW_MS / waited);
      this.wanted = Math.max(SCALES[SCALES.length - 1], 0.5 * (this.scale + enough));
    } else if (waited < FAST_MS) {
      this.wanted = Math.min(1, this.wanted * 1.01);
    }
  }
}

/** The largest of `SCALES` that is not above the wanted one. @param {number} wanted */
const rung = (wanted) => SCALES.find((scale) => scale <= wanted) ?? SCALES[SCALES.length - 1];
