/**
 * Requests to the kernel over the widget's custom messages. Every request has an id and is
 * answered, errors included; progress may arrive in between. The kernel's twin is
 * `sunwidget/widgets/requests.py`.
 *
 * browser → kernel  { type: "request", id, action, … }
 * kernel → browser  { type: "progress", id, fraction, message }
 *                   { type: "response", id, result, error } with buffers
 */

/**
 * @typedef {import("./types.js").Model} Model
 * @typedef {{ result: any, buffers: DataView[] }} Answer
 * @typedef {(fraction: number, message: string) => void} OnProgress
 */

export class Channel {
  /**
   * @param {Model} model
   * @param {AbortSignal} signal ends the channel; requests still open then fail
   */
  constructor(model, signal) {
    this.model = model;
    /** @type {Map<string, { resolve: (answer: Answer) => void, reject: (error: Error) => void, onProgress?: OnProgress }>} */
    this.open = new Map();
    /** @type {(message: any, buffers: DataView[]) => void} */
    const receive = (message, buffers) => this.receive(message, buffers);
    model.on("msg:custom", receive);
    signal.addEventListener("abort", () => {
      model.off("msg:custom", receive);
      for (const { reject } of this.open.values()) reject(new Error("The editor was closed."));
      this.open.clear();
    });
  }

  /**
   * @param {string} action
   * @param {Record<string, unknown>} [content]
   * @param {OnProgress} [onProgress]
   * @returns {Promise<Answer>}
   */
  request(action, content = {}, onProgress = undefined) {
    const id = crypto.randomUUID?.() ?? String(Math.random());
    return new Promise((resolve, reject) => {
      this.open.set(id, { resolve, reject, onProgress });
      this.model.send({ ...content, type: "request", id, action });
    });
  }

  /**
   * @param {any} message
   * @param {DataView[]} buffers
   */
  receive(message, buffers) {
    const pending = this.open.get(message?.id);
    if (!pending) return;
    if (message.type === "progress") {
      pending.onProgress?.(message.fraction, message.message);
      return;
    }
    if (message.type !== "response") return;
    this.open.delete(message.id);
    if (message.error) pending.reject(new Error(message.error));
    else pending.resolve({ result: message.result, buffers: buffers ?? [] });
  }
}
