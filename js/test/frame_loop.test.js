import assert from "node:assert/strict";
import { test } from "node:test";
import { FrameLoop } from "../src/gl/frame_loop.js";

/** A loop whose frames come when the test says so, each after `wait` ms. */
function loopOf(context, { dragging = () => true } = {}) {
  const drawn = [];
  let [now, frame] = [0, null];
  context.mock.method(performance, "now", () => now);
  context.mock.timers.enable({ apis: ["setTimeout"] });
  globalThis.requestAnimationFrame = (callback) => {
    frame = callback;
    return 1;
  };
  globalThis.cancelAnimationFrame = () => {
    frame = null;
  };
  const stop = new AbortController();
  const loop = new FrameLoop((scale) => drawn.push(scale), dragging, stop.signal);
  const run = (wait) => {
    now += wait;
    const callback = frame;
    frame = null;
    callback?.();
  };
  const step = (wait) => {
    loop.request();
    run(wait);
  };
  return { loop, drawn, step, run, stop, pending: () => frame !== null };
}

test("a machine that is behind draws smaller, in few sizes, and one that is not returns", (t) => {
  const { drawn, step } = loopOf(t);
  for (let i = 0; i < 3; i++) step(16);
  assert.deepEqual(drawn, [1, 1, 1]);
  for (let i = 0; i < 24; i++) step(200);
  assert.equal(drawn.at(-1), 0.35);
  for (let i = 0; i < 200; i++) step(16);
  assert.equal(drawn.at(-1), 1);
  assert.ok(new Set(drawn).size <= 7);
});

test("at a speed in between the size stays", (t) => {
  const { drawn, step } = loopOf(t);
  for (let i = 0; i < 6; i++) step(60);
  step(25);
  const [reached] = drawn.slice(-1);
  assert.ok(reached < 1);
  for (let i = 0; i < 50; i++) step(25);
  assert.ok(drawn.slice(-50).every((scale) => scale === reached));
});

test("the first frame of a scene is as large as it is seen, and in full as soon as nothing moves", (t) => {
  const { loop, drawn, step, run } = loopOf(t, { dragging: () => false });
  loop.limit = () => 0.4;
  loop.first = true;
  step(16);
  t.mock.timers.tick(10_000);
  run(16);
  step(16);
  assert.deepEqual(drawn, [0.4, 1, 1]);
  loop.limit = () => 1;
  loop.first = true;
  step(16);
  t.mock.timers.tick(10_000);
  run(16);
  assert.deepEqual(drawn, [0.4, 1, 1, 1], "what is seen in full is not drawn twice");
});

test("a slow hand is no slow machine", (t) => {
  const { drawn, step } = loopOf(t);
  for (let i = 0; i < 20; i++) {
    step(16);
    t.mock.timers.tick(100); // until the next move of the hand
  }
  assert.ok(drawn.every((scale) => scale === 1));
});

test("a hand that rests gets the picture in full, and so does the end of a drag", (t) => {
  let dragging = true;
  const { loop, drawn, step, run, pending } = loopOf(t, { dragging: () => dragging });
  for (let i = 0; i < 12; i++) step(200);
  assert.ok(drawn.at(-1) < 1 && loop.busy);
  t.mock.timers.tick(300);
  assert.ok(!pending(), "slow frames: the hand may still be on its way");
  t.mock.timers.tick(300);
  assert.ok(pending());
  run(16);
  assert.equal(drawn.at(-1), 1);
  assert.ok(!loop.busy, "it is drawn in full once");
  step(16);
  assert.ok(drawn.at(-1) < 1, "the hand moves on");
  dragging = false;
  step(16);
  assert.equal(drawn.at(-1), 1);
  assert.ok(!loop.busy);
});

test("a drag draws no more than can be seen, a rest all of it", (t) => {
  const { loop, drawn, step, run } = loopOf(t);
  loop.limit = () => 0.45;
  for (let i = 0; i < 30; i++) step(16);
  assert.deepEqual(new Set(drawn), new Set([0.45]));
  for (let i = 0; i < 8; i++) step(100);
  assert.equal(drawn.at(-1), 0.35);
  t.mock.timers.tick(1000);
  run(16);
  assert.equal(drawn.at(-1), 1);
});

test("requests of one refresh are one frame; a view that ends draws no more", (t) => {
  const { loop, drawn, run, stop } = loopOf(t);
  loop.request();
  loop.request();
  run(16);
  assert.equal(drawn.length, 1);
  loop.request();
  stop.abort();
  run(16);
  assert.equal(drawn.length, 1);
});
