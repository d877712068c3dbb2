/**
 * Requests to the kernel over the widget's custom messages. Every request has an id and is
 * answered, errors included; progress may arrive in between. The kernel's twin is
 * `sunwidget/widgets/kernel/requests.py`.
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
 * @typedef {{
 *   resolve: (answer: Answer) => void, reject: (error: Error) => void, pieces: DataView[],
 *   onProgress?: OnProgress, outlives: boolean, timer?: ReturnType<typeof setTimeout>,
 * }} Pending `outlives` the channel: the kernel makes a file of its own of it
 */

// A kernel that says nothing for so long was restarted or is gone.
const SILENCE_MS = 180_000;
export const GONE = "The kernel is gone. Run the cell again.";
const SILENT = "The kernel is not responding. If it was restarted, run the cell again.";

/** The person wants the answer no more. */
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
    /** @type {() => void} called when the host can send nothing: it has shut the kernel down */
    this.onGone = () => {};
    /** @type {(message: any, buffers: DataView[]) => void} */
    const receive = (message, buffers) => this.receive(message, buffers);
    model.on("msg:custom", receive);
    signal.addEventListener("abort", () => {
      model.off("msg:custom", receive);
      for (const [id, { outlives }] of this.open) {
        this.end(id)?.reject(new Error("The editor was closed."));
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

  /** The kernel is gone, and with it all that it was asked. @param {string} reason */
  lose(reason) {
    for (const id of [...this.open.keys()]) this.end(id)?.reject(new Error(reason));
  }

  /** Take a request off the list, which still has to be told. @param {string} id */
  end(id) {
    const pending = this.open.get(id);
    this.open.delete(id);
    clearTimeout(pending?.timer);
    return pending;
  }

  /** @param {string} id @param {Error} error */
  giveUp(id, error) {
    const pending = this.end(id);
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

  /** Give up a request about which nothing is heard any more. @param {string} id */
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
      this.end(message.id);
      const { result, error } = message;
      if (error) pending.reject(new Error(error));
      else pending.resolve({ result, buffers: [...pending.pieces, ...(buffers ?? [])] });
    }
  }
}
