/**
 * Sends requests to the kernel as the widget's custom messages. Every request has an id and gets an
 * answer or an error; progress may arrive in between. The kernel's twin is
 * `sunwidget/widgets/kernel/requests.py`.
 *
 * browser → kernel  { type: "request", id, action, … }
 *                   { type: "cancel", id }
 * kernel → browser  { type: "progress", id, fraction, message }
 *                   { type: "piece", id } with a buffer that precedes the response's own
 *                   { type: "response", id, result, error } with buffers
 */

/**
 * @typedef {import("./types.js").Model} Model
 * @typedef {{ result: any, buffers: DataView[] }} Answer
 * @typedef {(fraction: number, message: string) => void} OnProgress
 * @typedef {{
 *   resolve: (answer: Answer) => void, reject: (error: Error) => void, pieces: DataView[],
 *   onProgress?: OnProgress, outlives: boolean, timer?: ReturnType<typeof setTimeout>,
 * }} Pending `outlives`: it continues after the channel closes, as it writes a file in the kernel
 */

// A kernel silent for this long was restarted or is gone.
const SILENCE_MS = 180_000;
export const GONE = "The kernel is gone. Run the cell again.";
const SILENT = "The kernel is not responding. If it was restarted, run the cell again.";

/** The user canceled the request. */
export class Canceled extends Error {}

export class Channel {
  /**
   * @param {Model} model
   * @param {AbortSignal} signal ends the channel; requests still open then fail
   */
  constructor(model, signal) {
    this.model = model;
    /** @type {Map<string, Pending>} */
    this.open = new Map();
    /** @type {() => void} called when the host cannot send because it has shut down the kernel */
    this.onGone = () => {};
    /** @type {(message: any, buffers: DataView[]) => void} */
    const receive = (message, buffers) => this.receive(message, buffers);
    model.on("msg:custom", receive);
    signal.addEventListener("abort", () => {
      model.off("msg:custom", receive);
      for (const [id, { outlives }] of this.open) {
        this.remove(id)?.reject(new Error("The editor was closed."));
        if (!outlives) this.sendCancel(id);
      }
    });
  }

  /**
   * @param {string} action
   * @param {Record<string, unknown>} [content]
   * @param {OnProgress} [onProgress]
   * @param {ArrayBuffer[]} [buffers]
   * @param {AbortSignal} [signal] cancels: the kernel stops at its next step, the promise rejects
   *   with `Canceled` at once
   * @returns {Promise<Answer>}
   */
  request(action, content = {}, onProgress = undefined, buffers = [], signal = undefined) {
    const id = crypto.randomUUID?.() ?? String(Math.random());
    return new Promise((resolve, reject) => {
      if (signal?.aborted) throw new Canceled("Canceled.");
      try {
        this.model.send({ ...content, type: "request", id, action }, undefined, buffers);
      } catch {
        this.onGone();
        throw new Error(GONE);
      }
      const outlives = content.in_folder === true;
      this.open.set(id, { resolve, reject, pieces: [], onProgress, outlives });
      this.watch(id);
      signal?.addEventListener("abort", () => this.giveUp(id, new Canceled("Canceled.")), {
        once: true,
      });
    });
  }

  /** Reject all open requests, as the kernel is gone. @param {string} reason */
  rejectAll(reason) {
    for (const id of [...this.open.keys()]) this.remove(id)?.reject(new Error(reason));
  }

  /** Remove a request and return it; the caller settles it. @param {string} id */
  remove(id) {
    const pending = this.open.get(id);
    this.open.delete(id);
    clearTimeout(pending?.timer);
    return pending;
  }

  /** @param {string} id @param {Error} error */
  giveUp(id, error) {
    const pending = this.remove(id);
    if (!pending) return;
    pending.reject(error);
    this.sendCancel(id);
  }

  /** @param {string} id */
  sendCancel(id) {
    try {
      this.model.send({ type: "cancel", id });
    } catch {
      // Without a connection there is nothing to stop.
    }
  }

  /** Give up a request if the kernel stays silent about it. @param {string} id */
  watch(id) {
    const pending = this.open.get(id);
    if (!pending) return;
    clearTimeout(pending.timer);
    pending.timer = setTimeout(() => this.giveUp(id, new Error(SILENT)), SILENCE_MS);
  }

  /**
   * @param {any} message
   * @param {DataView[]} buffers
   */
  receive(message, buffers) {
    const pending = this.open.get(message?.id);
    if (!pending) return;
    if (message.type === "progress") {
      this.watch(message.id);
      pending.onProgress?.(message.fraction, message.message);
    } else if (message.type === "piece") {
      this.watch(message.id);
      pending.pieces.push(...buffers);
    } else if (message.type === "response") {
      this.remove(message.id);
      const { result, error } = message;
      if (error) pending.reject(new Error(error));
      else pending.resolve({ result, buffers: [...pending.pieces, ...(buffers ?? [])] });
    }
  }
}
