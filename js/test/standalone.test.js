import assert from "node:assert/strict";
import test from "node:test";
import { Canceled, Channel } from "../src/host/channel.js";
import { NO_KERNEL, StandaloneModel, stateOf } from "../src/standalone/model.js";

test("binary traits stand where they were, as anywidget gives them", () => {
  const state = stateOf({
    state: { a: null, b: { list: [1, null] } },
    buffers: [
      { path: ["a"], data: "AQI=" },
      { path: ["b", "list", 1], data: "Aw==" },
    ],
  });
  assert.deepEqual([state.a.getUint8(0), state.a.getUint8(1), state.a.byteLength], [1, 2, 2]);
  assert.equal(state.b.list[0], 1);
  assert.equal(state.b.list[1].getUint8(0), 3);
});

test("a set value is heard once, by those who still listen", () => {
  const model = new StandaloneModel({ exposure: 0 });
  const heard = [];
  const listen = () => heard.push(model.get("exposure"));
  model.on("change:exposure", listen);
  model.set("exposure", 1);
  model.set("exposure", 1);
  model.save_changes();
  model.off("change:exposure", listen);
  model.set("exposure", 2);
  assert.deepEqual(heard, [1]);
  assert.equal(model.get("_standalone"), true);
});

test("what is asked of the kernel is answered at once: there is none", async () => {
  const channel = new Channel(new StandaloneModel({}), new AbortController().signal);
  await assert.rejects(channel.request("map", { name: "sky" }), { message: NO_KERNEL });
  assert.equal(channel.open.size, 0);
});

test("a request that is canceled ends at once, and the kernel hears of it", async () => {
  const sent = [];
  const model = { on() {}, off() {}, send: (content) => sent.push(content) };
  const channel = new Channel(model, new AbortController().signal);
  const work = new AbortController();
  const request = channel.request("save", {}, undefined, [], work.signal);
  work.abort();
  work.abort();
  await assert.rejects(request, Canceled);
  assert.deepEqual(sent[1], { type: "cancel", id: sent[0].id });
  assert.equal(sent.length, 2);
});

test("a request that was answered is not canceled any more", async () => {
  const sent = [];
  const listeners = [];
  const model = { on: (_, f) => listeners.push(f), off() {}, send: (c) => sent.push(c) };
  const channel = new Channel(model, new AbortController().signal);
  const work = new AbortController();
  const request = channel.request("save", {}, undefined, [], work.signal);
  for (const tell of listeners) tell({ type: "response", id: sent[0].id, result: { done: 1 } }, []);
  work.abort();
  assert.deepEqual((await request).result, { done: 1 });
  assert.equal(sent.length, 1);
});
