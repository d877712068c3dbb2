/** A stand-in for anywidget's model, without a browser. */
export class FakeModel {
  constructor(state) {
    this.state = state;
    this.listeners = {};
    this.saves = 0;
    this.sent = [];
  }
  get(name) {
    return this.state[name];
  }
  set(name, value) {
    this.state[name] = value;
    this.fire(`change:${name}`);
  }
  save_changes() {
    this.saves += 1;
  }
  send(content) {
    this.sent.push(content);
  }
  on(event, callback) {
    this.listeners[event] = [...(this.listeners[event] ?? []), callback];
  }
  off(event, callback) {
    this.listeners[event] = (this.listeners[event] ?? []).filter((c) => c !== callback);
  }
  fire(event, ...values) {
    for (const callback of this.listeners[event] ?? []) callback(...values);
  }
}
