import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { Channel } from "../src/host/channel.js";
import { FakeModel } from "./fake_model.js";

const open = () => {
  const model = new FakeModel({});
  const controller = new AbortController();
  return { model, controller, channel: new Channel(model, controller.signal) };
};

test("answers find their requests, also out of order", async () => {
  const { model, channel } = open();
  const [first, second] = [channel.request("save"), channel.request("save")];
  const [a, b] = model.sent.map(({ id }) => id);
  model.fire("msg:custom", { type: "response", id: b, result: 2 }, []);
  model.fire("msg:custom", { type: "response", id: a, result: 1 }, []);
  assert.deepEqual([(await first).result, (await second).result], [1, 2]);
});

test("the kernel's error is the request's error", async () => {
  const { model, channel } = open();
  const request = channel.request("save");
  model.fire("msg:custom", { type: "response", id: model.sent[0].id, error: "Disk full." });
  await assert.rejects(request, /Disk full\./);
});

test("progress arrives before the answer", async () => {
  const { model, channel } = open();
  const seen = [];
  const request = channel.request("save", {}, (fraction) => seen.push(fraction));
  const { id } = model.sent[0];
  model.fire("msg:custom", { type: "progress", id, fraction: 0.5, message: "" });
  model.fire("msg:custom", { type: "response", id, result: {} }, []);
  await request;
  assert.deepEqual(seen, [0.5]);
});

test("a large answer comes in pieces, in their order", async () => {
  const { model, channel } = open();
  const request = channel.request("film");
  const { id } = model.sent[0];
  const [a, b, c] = [1, 2, 3].map((byte) => new DataView(Uint8Array.of(byte).buffer));
  model.fire("msg:custom", { type: "piece", id }, [a]);
  model.fire("msg:custom", { type: "piece", id }, [b]);
  model.fire("msg:custom", { type: "response", id, result: {} }, [c]);
  const bytes = (await request).buffers.map((view) => view.getUint8(0));
  assert.deepEqual(bytes, [1, 2, 3]);
});

test("what comes after the answer, twice or for nobody is left alone", async () => {
  const { model, channel } = open();
  const seen = [];
  const request = channel.request("save", {}, (fraction) => seen.push(fraction));
  const { id } = model.sent[0];
  const answer = (result) => model.fire("msg:custom", { type: "response", id, result }, []);
  answer(1);
  answer(2);
  model.fire("msg:custom", { type: "progress", id, fraction: 0.9, message: "" });
  model.fire("msg:custom", { type: "response", id: "another", result: 3 }, []);
  assert.equal((await request).result, 1);
  assert.deepEqual(seen, []);
});

test("closing the view ends what is open, except a file that the kernel keeps", async () => {
  const { model, controller, channel } = open();
  const requests = [channel.request("save"), channel.request("film", { in_folder: true })];
  const [{ id }] = model.sent;
  controller.abort();
  for (const request of requests) await assert.rejects(request, /closed/);
  assert.deepEqual(model.sent.slice(2), [{ type: "cancel", id }]);
});

test("with the kernel goes all that it was asked, at once", async () => {
  const { channel } = open();
  const request = channel.request("save");
  channel.rejectAll("The kernel is gone.");
  await assert.rejects(request, /The kernel is gone/);
  assert.equal(channel.open.size, 0);
});

test("what cannot be sent ends at once in plain words, and can be canceled all the same", async () => {
  const { model, channel } = open();
  const stop = new AbortController();
  const sent = channel.request("save", {}, undefined, [], stop.signal);
  model.send = () => {
    throw new Error("Cannot send");
  };
  let gone = 0;
  channel.onGone = () => {
    gone += 1;
  };
  await assert.rejects(channel.request("save"), /The kernel is gone\. Run the cell again\./);
  assert.equal(gone, 1);
  stop.abort();
  await assert.rejects(sent, /Canceled/);
  assert.equal(channel.open.size, 0);
});

test("a kernel that falls silent is said, one that reports progress is waited for", async () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  const { model, channel } = open();
  const request = channel.request("save");
  const { id } = model.sent[0];
  mock.timers.tick(170_000);
  model.fire("msg:custom", { type: "progress", id, fraction: 0.5, message: "" });
  mock.timers.tick(170_000);
  assert.equal(channel.open.size, 1);
  mock.timers.tick(20_000);
  mock.timers.reset();
  await assert.rejects(request, /is not responding/);
  // It may only have been busy: what nobody waits for shall not be made later.
  assert.deepEqual(model.sent.at(-1), { type: "cancel", id });
});
