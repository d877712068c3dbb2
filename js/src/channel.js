/**
 * Requests to the kernel over the widget's custom messages. Every request has an id and is
 * answered, errors included; progress may arrive in between. The kernel's twin is
 * `sunwidget/widgets/requests.py`.
 *
 * browser → kernel  { type: "request", id, action, … }
 *                   { type: "cancel", id }
 * kernel → browser  { type: "progress", id, fraction, message }
 *                   { type: "piece", id } with a buffer that comes before the response's own
 *                   { type: "response", id, result, error } with buffers
 */

/**
 * @typedef {import("./types.js").Model} Model
 * @typedef {{ result: any, buffers: DataView[] }} Answer
 * @typedef {(fraction: number, message: string) => void} OnProgress
 */

// A kernel that says nothing for so long was restarted or is gone.
const SILENCE_MS = 180_000;

/** The person wants the answer no more. */
export class Cancelled extends Error {}

export class Channel {
  /**
   * @param {Model} model
   * @param {AbortSignal} signal ends the channel; requests still open then fail
   */
  constructor(model, signal) {
    this.model = model;
    /** @type {Map<string, { resolve: (answer: Answer) => void, reject: (error: Error) => void, pieces: DataView[], onProgress?: OnProgress, timer?: ReturnType<typeof setTimeout> }>} */
    this.open = new Map();
    /** @type {(message: any, buffers: DataView[]) => void} */
    const receive = (message, buffers) => this.receive(message, buffers);
    model.on("msg:custom", receive);
    signal.addEventListener("abort", () => {
      model.off("msg:custom", receive);
      for (const { reject, timer } of this.open.values()) {
        clearTimeout(timer);
        reject(new Error("The editor was closed."));
      }
      this.open.clear();
    });
  }

  /**
   * @param {string} action
   * @param {Record<string, unknown>} [content]
   * @param {OnProgress} [onProgress]
   * @param {ArrayBuffer[]} [buffers]
   * @param {AbortSignal} [signal] cancels: the kernel stops at its next step, the promise rejects
   *   with `Cancelled` at once
   * @returns {Promise<Answer>}
   */
  request(action, content = {}, onProgress = undefined, buffers = [], signal = undefined) {
    const id = crypto.randomUUID?.() ?? String(Math.random());
    return new Promise((resolve, reject) => {
      this.open.set(id, { resolve, reject, pieces: [], onProgress });
      this.watch(id);
      this.model.send({ ...content, type: "request", id, action }, undefined, buffers);
      signal?.addEventListener("abort", () => this.cancel(id), { once: true });
    });
  }

  /** @param {string} id */
  cancel(id) {
    const pending = this.open.get(id);
    if (!pending) return;
    this.open.delete(id);
    clearTimeout(pending.timer);
    pending.reject(new Cancelled("Cancelled."));
    this.model.send({ type: "cancel", id });
  }

  /** Give up a request about which nothing is heard any more. @param {string} id */
  watch(id) {
    const pending = this.open.get(id);
    if (!pending) return;
    clearTimeout(pending.timer);
    pending.timer = setTimeout(() => {
      this.open.delete(id);
      pending.reject(
        new Error("The kernel does not answer. If it was restarted, run the cell again."),
      );
    }, SILENCE_MS);
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
      return;
    }
    if (message.type === "piece") {
      this.watch(message.id);
      pending.pieces.push(...buffers);
      return;
    }
    if (message.type !== "response") return;
    this.open.delete(message.id);
    clearTimeout(pending.timer);
    if (message.error) pending.reject(new Error(message.error));
    else {
      pending.resolve({
        result: message.result,
        buffers: [...pending.pieces, ...(buffers ?? [])],
      });
    }
  }
}
