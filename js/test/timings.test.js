import assert from "node:assert/strict";
import { test } from "node:test";
import { Timings, wantsTimings } from "../src/editor/view/timings.js";
import { cardName, Stopwatch } from "../src/gl/stopwatch.js";

/** A context whose card answers when it is told to. */
function card({ timer = false } = {}) {
  const state = { done: false, lost: false, nanoseconds: 12.5e6, disjoint: false };
  const extensions = {
    EXT_disjoint_timer_query_webgl2: timer ? { TIME_ELAPSED_EXT: 1, GPU_DISJOINT_EXT: 2 } : null,
    WEBGL_debug_renderer_info: null,
  };
  return {
    state,
    RENDERER: 7,
    QUERY_RESULT: 8,
    QUERY_RESULT_AVAILABLE: 9,
    TIMEOUT_EXPIRED: 10,
    SYNC_GPU_COMMANDS_COMPLETE: 11,
    getExtension: (name) => extensions[name],
    getParameter: (name) => (name === 7 ? "A card" : state.disjoint),
    isContextLost: () => state.lost,
    createQuery: () => ({}),
    beginQuery() {},
    endQuery() {},
    deleteQuery() {},
    getQueryParameter: (_, what) => (what === 8 ? state.nanoseconds : state.done),
    fenceSync: () => ({}),
    flush() {},
    deleteSync() {},
    clientWaitSync: () => (state.done ? 0 : 10),
  };
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** What a stopwatch tells of one frame, whose card is done after 20 ms. */
async function measured(gl) {
  const laps = [];
  const watch = new Stopwatch((lap) => laps.push(lap));
  assert.equal(
    watch.time(gl, () => "drawn"),
    "drawn",
  );
  await pause(20);
  assert.deepEqual(laps, [], "told before the card was done");
  assert.ok(watch.running);
  gl.state.done = true;
  await pause(30);
  return { laps, watch };
}

test("the card's own clock is read where it may be", async () => {
  const { laps, watch } = await measured(card({ timer: true }));
  assert.deepEqual(laps, [{ ms: 12.5, by: "timer query" }]);
  assert.ok(!watch.running);
});

test("without it the time runs until a fence has passed", async () => {
  const { laps } = await measured(card());
  assert.equal(laps.length, 1);
  assert.equal(laps[0].by, "fence");
  assert.ok(laps[0].ms >= 19, `${laps[0].ms} ms`);
});

test("a clock that was changed meanwhile tells nothing", async () => {
  const gl = card({ timer: true });
  gl.state.disjoint = true;
  const { laps, watch } = await measured(gl);
  assert.deepEqual(laps, []);
  assert.ok(!watch.running);
});

test("frames that are drawn while one is measured are drawn all the same", async () => {
  const gl = card();
  const laps = [];
  const watch = new Stopwatch((lap) => laps.push(lap));
  watch.time(gl, () => 1);
  assert.equal(
    watch.time(gl, () => 2),
    2,
  );
  gl.state.done = true;
  await pause(30);
  assert.equal(laps.length, 1);
});

test("a lost context and a failed frame end the measurement", async () => {
  const lost = card();
  const watch = new Stopwatch(() => assert.fail("nothing was measured"));
  watch.time(lost, () => 1);
  lost.state.lost = true;
  await pause(20);
  assert.ok(!watch.running);
  assert.throws(() =>
    watch.time(card(), () => {
      throw new Error("no shader");
    }),
  );
  assert.ok(!watch.running);
});

test("the median of the last frames of one size is shown", () => {
  const timed = new Timings();
  assert.equal(timed.text(), "");
  for (const ms of [90, 9.04, 8, 10]) timed.add({ ms, by: "fence" }, "640 × 480");
  assert.equal(timed.text(), "640 × 480 in 9.0 ms (fence, median of 4)");
  timed.add({ ms: 2.345, by: "fence" }, "320 × 240");
  assert.equal(timed.text(), "320 × 240 in 2.3 ms (fence, median of 1)");
});

test("the card has a name; only ?timings asks for the live row", () => {
  assert.equal(cardName(card()), "A card");
  assert.ok(wantsTimings("https://host/lab/tree/a.ipynb?timings"));
  assert.ok(wantsTimings("file:///photo.html?timings=1"));
  assert.ok(!wantsTimings("https://host/lab/tree/timings.ipynb"));
  assert.ok(!wantsTimings("about:srcdoc"));
});
