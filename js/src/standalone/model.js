/**
 * A widget's model in a stand-alone page: the embedded state, without a kernel.
 *
 * It behaves like anywidget's model. Requests to the kernel are answered at once with an error that
 * says what to do.
 */

/**
 * @typedef {import("../host/types.js").Model} Model
 * @typedef {(...args: any[]) => void} Listener
 */

export const NO_KERNEL = "This page has no kernel. Open the photo in a notebook for this.";

/** @implements {Model} */
export class StandaloneModel {
  /** @param {Record<string, unknown>} state */
  constructor(state) {
    this.state = { ...state, _standalone: true };
    /** @type {Map<string, Set<Listener>>} */
    this.listeners = new Map();
  }

  /** @param {string} name @returns {any} */
  get(name) {
    return /** @type {Record<string, unknown>} */ (this.state)[name];
  }

  /**
   * @param {string} name
   * @param {unknown} value
   */
  set(name, value) {
    if (this.get(name) === value) return;
    Object.assign(this.state, { [name]: value });
    this.fire(`change:${name}`);
  }

  save_changes() {
    // Nothing to save to: the state is the page's own.
  }

  /** @param {any} content */
  send(content) {
    if (content?.type !== "request") return;
    const { id } = content;
    queueMicrotask(() =>
      this.fire("msg:custom", { type: "response", id, result: null, error: NO_KERNEL }, []),
    );
  }

  /**
   * @param {string} event
   * @param {Listener} callback
   */
  on(event, callback) {
    const own = this.listeners.get(event) ?? new Set();
    this.listeners.set(event, own.add(callback));
  }

  /**
   * @param {string} event
   * @param {Listener} callback
   */
  off(event, callback) {
    this.listeners.get(event)?.delete(callback);
  }

  /**
   * @param {string} event
   * @param {unknown[]} args
   */
  fire(event, ...args) {
    // Copy the set: a listener may remove itself or add another.
    for (const callback of [...(this.listeners.get(event) ?? [])]) callback(...args);
  }
}

/**
 * Return the traits of an embedded widget, binary ones as anywidget provides them.
 *
 * @param {{ state: Record<string, any>, buffers: { path: (string | number)[], data: string }[] }} content
 *   as `ipywidgets.embed` writes it
 * @returns {Record<string, unknown>}
 */
export function stateOf({ state, buffers }) {
  for (const { path, data } of buffers) {
    /** @type {any} */
    let place = state;
    for (const key of path.slice(0, -1)) place = place[key];
    place[path[path.length - 1]] = bytes(data);
  }
  return state;
}

/** @param {string} base64 */
function bytes(base64) {
  const text = atob(base64);
  return new DataView(Uint8Array.from(text, (char) => char.charCodeAt(0)).buffer);
}
