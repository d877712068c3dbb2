// A stand-in for anywidget's model: what a notebook's comm would carry lies in plain arrays.
export class FakeModel {
  constructor(state) {
    this.state = state;
    this.listeners = new Map();
    this.saved = []; // one snapshot of the changed names a save_changes()
    this.sent = [];
    this.asked = 0; // how often for a sign of life
    this.dirty = {};
  }
  get(name) {
    return this.state[name];
  }
  set(name, value) {
    if (this.state[name] === value) return;
    this.state[name] = value;
    this.dirty[name] = value;
    this.fire(`change:${name}`, this); // as ipywidgets' models name themselves
  }
  save_changes() {
    if (Object.keys(this.dirty).length) this.saved.push(this.dirty);
    this.dirty = {};
  }
  send(content) {
    if (content.action === "alive") {
      this.asked += 1;
      this.fire("msg:custom", { type: "response", id: content.id });
    } else this.sent.push(content);
  }
  on(event, callback) {
    if (!this.listeners.has(event)) this.listeners.set(event, new Set());
    this.listeners.get(event).add(callback);
  }
  off(event, callback) {
    this.listeners.get(event)?.delete(callback);
  }
  fire(event, ...args) {
    for (const callback of [...(this.listeners.get(event) ?? [])]) callback(...args);
  }
  // As if the kernel had set these traits: all values first, then the events.
  receive(state) {
    Object.assign(this.state, state);
    for (const name of Object.keys(state)) this.fire(`change:${name}`);
  }
  // The same in marimo, which tells after each value.
  receiveOneByOne(state) {
    for (const [name, value] of Object.entries(state)) this.receive({ [name]: value });
  }
}

export function bytes(base64) {
  const text = atob(base64);
  const data = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) data[i] = text.charCodeAt(i);
  return new DataView(data.buffer);
}
