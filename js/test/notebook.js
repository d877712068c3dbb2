/**
 * A notebook as it looks from a view: models, the host that carries their messages and a kernel,
 * all on mocked timers. As ipywidgets' models do, one holds its changes back while the kernel has
 * not yet worked through the last, sends requests at once, and takes no echo older than its own
 * last change. Delays, and what else goes wrong on the way, follow from a seed.
 */

/** Random numbers in 0–1 that a seed repeats (mulberry32). */
export function randomOf(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const copy = (value) => JSON.parse(JSON.stringify(value));

export class Notebook {
  /**
   * @param {object} options `state` of the widget's traits; `random` as of `randomOf`; `delay` in ms
   *   at most; of custom messages `twice` and `lost`: how likely one comes twice or never, and
   *   `shuffled`: whether one may overtake another; `work(request)` returns a response's result, or
   *   throws
   */
  constructor({ state, random, delay = 400, twice = 0, lost = 0, shuffled = false, work }) {
    this.traits = copy(state);
    this.random = random;
    this.faults = { delay, twice, lost, shuffled };
    this.work = work ?? (() => ({}));
    this.models = [];
    this.onTheWay = 0;
    this.canceled = new Set();
    this.steps = 0; // numbers of messages
  }

  /** A page that shows the widget: it has the state as it is now. */
  model() {
    const model = new NotebookModel(this, copy(this.traits));
    this.models.push(model);
    return model;
  }

  /** Whether nothing is under way any more. */
  get quiet() {
    return this.onTheWay === 0 && this.models.every(({ held }) => held === null);
  }

  /** Carry a message with traits: late, but all of one way in their order. */
  carry(way, arrive) {
    way.latest = Math.max(Date.now() + this.random() * this.faults.delay, way.latest ?? 0);
    this.after(way.latest - Date.now(), arrive);
  }

  /** Carry a custom message, whatever befalls it. */
  carryCustom(way, arrive) {
    const { delay, twice, lost, shuffled } = this.faults;
    if (this.random() < lost) return;
    const copies = this.random() < twice ? 2 : 1;
    for (let i = 0; i < copies; i++) {
      if (shuffled) this.after(this.random() * delay, arrive);
      else this.carry(way, arrive);
    }
  }

  after(wait, act) {
    this.onTheWay += 1;
    setTimeout(() => {
      this.onTheWay -= 1;
      act();
    }, wait);
  }

  /** The kernel gets a model's changes: its traits change, and every page hears so. */
  take(model, id, changes) {
    Object.assign(this.traits, copy(changes));
    for (const other of this.models) {
      this.carry(other.inbox, () => other.echo(other === model ? id : `${id} of another`, changes));
    }
    this.carry(model.inbox, () => model.worked());
  }

  /** What a cell sets. */
  set(changes) {
    Object.assign(this.traits, copy(changes));
    for (const model of this.models) this.carry(model.inbox, () => model.receive(copy(changes)));
  }

  /** The kernel gets a custom message. */
  hear(content) {
    if (content.type === "cancel") this.canceled.add(content.id);
    if (content.type !== "request") return;
    const { id } = content;
    const say = (message) => {
      for (const model of this.models) {
        this.carryCustom(model.inbox, () => model.fire("msg:custom", { id, ...message }, []));
      }
    };
    const steps = Math.floor(4 * this.random());
    const step = (i) => {
      if (this.canceled.has(id)) return say({ type: "response", error: "Canceled." });
      if (i < steps) {
        say({ type: "progress", fraction: i / steps, message: "" });
        return this.after(200 * this.random(), () => step(i + 1));
      }
      try {
        say({ type: "response", result: this.work(content) });
      } catch (error) {
        say({ type: "response", error: error.message });
      }
    };
    step(0);
  }
}

/** The model of a page, as anywidget hands it to a view. */
class NotebookModel {
  constructor(notebook, state) {
    this.notebook = notebook;
    this.state = state;
    this.listeners = new Map();
    this.dirty = {};
    this.held = null; // changes that wait until the kernel has worked through the last
    this.pending = 0;
    this.expected = new Map(); // by name: the last message that changed it
    this.outbox = {};
    this.inbox = {};
  }
  get(name) {
    return this.state[name];
  }
  set(name, value) {
    if (same(this.state[name], value)) return;
    this.state[name] = value;
    this.dirty[name] = value;
    this.fire(`change:${name}`);
  }
  save_changes() {
    const changes = copy(this.dirty);
    this.dirty = {};
    if (!Object.keys(changes).length) return;
    if (this.pending > 0) this.held = { ...this.held, ...changes };
    else this.post(changes);
  }
  post(changes) {
    const { notebook } = this;
    notebook.steps += 1;
    const id = notebook.steps;
    for (const name of Object.keys(changes)) this.expected.set(name, id);
    this.pending += 1;
    notebook.carry(this.outbox, () => notebook.take(this, id, changes));
  }
  /** The kernel has worked through a message. */
  worked() {
    this.pending = Math.max(0, this.pending - 1);
    if (this.pending > 0 || this.held === null) return;
    const { held } = this;
    this.held = null;
    this.post(held);
  }
  echo(id, changes) {
    const taken = copy(changes);
    for (const name of Object.keys(taken)) {
      if (!this.expected.has(name)) continue;
      if (this.expected.get(name) !== id) delete taken[name];
      else {
        this.expected.delete(name);
        if (this.held && name in this.held) delete taken[name];
      }
    }
    this.receive(taken);
  }
  receive(state) {
    const changed = Object.keys(state).filter((name) => !same(this.state[name], state[name]));
    for (const name of changed) this.state[name] = state[name];
    for (const name of changed) this.fire(`change:${name}`);
  }
  send(content) {
    const { notebook } = this;
    notebook.carryCustom(this.outbox, () => notebook.hear(copy(content)));
  }
  on(event, callback) {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), callback]);
  }
  off(event, callback) {
    const left = (this.listeners.get(event) ?? []).filter((one) => one !== callback);
    this.listeners.set(event, left);
  }
  fire(event, ...values) {
    for (const callback of this.listeners.get(event) ?? []) callback(...values);
  }
}
