/**
 * When a view draws: once a refresh of the screen at most, only while it is in sight, smaller while
 * a drag lasts and the machine is behind, and in full as soon as the hand rests. The first frame of
 * a scene, which all that is kept of it is drawn for, is no larger than it can be seen either.
 */

const SLOW_MS = 33; // a frame that waits longer makes the next ones smaller
const FAST_MS = 18; // waiting for the screen's next refresh takes as long
// Sizes that a drag may take. Few, since with a new size all of the picture's passes are drawn again.
const SCALES = [1, 0.84, 0.71, 0.59, 0.5, 0.42, 0.35];
// Frames after a new size: the first draws what later ones find drawn, the second waits for it.
const UNLIKE_FRAMES = 2;
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
    this.signal = signal;
    this.inSight = true;
    this.owed = false; // a frame was asked for while out of sight
    /** @type {() => number} the largest scale that can be seen while a drag lasts */
    this.limit = () => 1;
    this.first = false; // whether somebody waits for the first frame of a scene
    this.wanted = 1; // the scale that would be just fast enough
    this.scale = 1; // the last one that was drawn
    this.unlike = UNLIKE_FRAMES; // how many frames still say nothing about speed
    this.pending = 0;
    this.asked = 0; // when the frame under way was asked for, ms
    this.spent = 0; // from asking for the last frame until it was drawn, ms
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

  /** Whether anybody can see the view: what it owes is drawn when it comes in sight. @param {boolean} inSight */
  setSight(inSight) {
    this.inSight = inSight;
    if (inSight && this.owed) this.schedule();
  }

  schedule() {
    this.owed = !this.inSight;
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
    const scale = small ? Math.min(rung(this.wanted), this.limit()) : 1;
    if (scale !== this.scale) this.unlike = UNLIKE_FRAMES;
    this.scale = scale;
    clearTimeout(this.settle);
    // Where frames take long, so do the hand's moves until they arrive.
    this.settle = small ? setTimeout(() => this.finish(), SETTLED_MS + 2 * this.spent) : undefined;
    this.draw(scale);
    // A machine that is behind lets a frame wait, or its drawing; a slow hand does neither.
    this.spent = performance.now() - asked;
    if (this.unlike > 0) this.unlike -= 1;
    else if (small) this.adapt(this.spent);
  }

  /** The hand rests: draw in full. */
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

/** The largest of `SCALES` that is not above the wanted one. @param {number} wanted */
const rung = (wanted) => SCALES.find((scale) => scale <= wanted) ?? SCALES[SCALES.length - 1];
