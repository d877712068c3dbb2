import assert from "node:assert/strict";
import { test } from "node:test";
import { Work } from "../src/editor/export/work.js";
import { Parts } from "../src/editor/part.js";
import { SunClock } from "../src/editor/place/sun_clock.js";
import { Hand } from "../src/editor/tools/hand.js";
import { kernelRequired } from "../src/editor/view/kernel_required.js";
import { Original } from "../src/editor/view/original.js";
import { Picture } from "../src/editor/view/picture.js";
import { showStatus } from "../src/editor/view/status.js";
import { Canceled } from "../src/host/channel.js";
import { FakeModel } from "./fake_model.js";

/** An element, as far as classes, titles and attributes go. */
class Node {
  constructor(title = "") {
    this.title = title;
    this.dataset = {};
    this.classes = new Set();
    this.disabled = false;
    this.classList = {
      toggle: (name, on) => (on ? this.classes.add(name) : this.classes.delete(name)),
    };
  }
  toggleAttribute(_name, on) {
    this.disabled = on;
  }
  querySelectorAll() {
    return [];
  }
}

test("parts are told in their order, and each only what it listens to", () => {
  const told = [];
  const parts = new Parts();
  parts.add({ loaded: () => told.push("a loaded"), show: () => told.push("a") });
  parts.add({ show: () => told.push("b"), point: (place) => told.push(place) });
  parts.loaded({});
  parts.point([0.5, 0.5]);
  parts.draw();
  assert.deepEqual(told, ["a loaded", "a", "b", [0.5, 0.5]]);
});

test("the picture shows the edit, a film's moment in its place, and else what was found", () => {
  const state = { values: { sun_elevation: 3, exposure: null }, recipe: () => ({ a: 1 }) };
  const picture = new Picture(new FakeModel({ _source: { fingerprint: "f" } }), state);
  assert.equal(picture.value("exposure"), 0);
  picture.take({ automatic: { exposure: 0.5 } }, null);
  assert.deepEqual([picture.value("sun_elevation"), picture.value("exposure")], [3, 0.5]);
  picture.passing = { sun_elevation: 9 };
  assert.equal(picture.value("sun_elevation"), 9);
  assert.deepEqual(picture.requestContent(), { recipe: { a: 1 }, photo: "f" });
  picture.forget();
  assert.equal(picture.value("exposure"), 0);
});

test("without a kernel the hand takes the sun alone", () => {
  const kernel = { answers: false };
  const hand = new Hand(kernel);
  const chosen = [];
  hand.onTool = () => chosen.push(hand.tool);
  hand.setTool("horizon");
  hand.setSubject("water");
  kernel.answers = true;
  hand.setTool("not_sky");
  hand.setSubject("sky");
  hand.setTool("horizon");
  hand.setSubject("water");
  assert.deepEqual(chosen, ["not_sky", "not_sky", "horizon", "sky"]);
});

test("a brush is never smaller or larger than it can be drawn", () => {
  const hand = new Hand({ answers: true });
  hand.setBrushRadius(1);
  assert.equal(hand.brushRadius, 0.06);
  hand.setBrushRadius(0);
  assert.equal(hand.brushRadius, 0.003);
});

/** Work with what it says. */
function atWork() {
  const said = [];
  const notices = { show: (_key, { text }) => said.push(text), hide: () => said.push("") };
  const work = new Work({ notices, stage: { setProgress() {} }, state: { push() {} } });
  return { work, said };
}

test("one thing is made at a time", async () => {
  const { work, said } = atWork();
  let end = () => {};
  const first = work.run("Saving", () => new Promise((resolve) => (end = resolve)));
  await work.run("Saving", () => assert.fail("made beside another"));
  assert.ok(work.busy);
  end();
  await first;
  assert.deepEqual([work.busy, said], [false, [""]]);
});

test("work that is canceled or fails says so in words", async () => {
  const { work, said } = atWork();
  const canceled = work.run("The export", async (signal) => {
    await new Promise((resolve) => signal.addEventListener("abort", resolve));
    throw new Canceled("canceled");
  });
  work.cancel();
  await canceled;
  await work.run("Saving", () => Promise.reject(new Error("no room")));
  assert.deepEqual(said, ["The export was canceled.", "Saving failed: no room"]);
});

test("the photo as it was stays for the split when Before goes", () => {
  const shown = [];
  let recipe = {};
  const root = new Node();
  const stage = { setOriginal: (on) => shown.push(on) };
  const original = new Original({ root, stage, state: { recipe: () => recipe } });
  original.setBefore(true);
  original.setSplit(true);
  assert.deepEqual([...root.classes], ["sw-before", "sw-split"]);
  assert.ok(!original.isOutdated());
  recipe = { exposure: 1 };
  assert.ok(original.isOutdated());
  original.setBefore(false);
  assert.ok(!original.isOutdated());
  original.setSplit(false);
  assert.deepEqual(shown, [true, true, true, false]);
});

test("the clock moves the sun along the day that the kernel sent, and no other", () => {
  const place = { latitude: 40, longitude: 0, date: "2024-06-01", time: 12, heading: 180 };
  const path = [
    [0, 180, -20, -20],
    [12, 180, 60, 60],
    [24, 180, -20, -20],
  ];
  const model = new FakeModel({});
  const set = [];
  const state = { values: { place }, set: (changes) => set.push(changes) };
  const clock = new SunClock({ model, picture: new Picture(model, state), state });
  clock.moveTo(12);
  assert.deepEqual([clock.path, set], [[], []]);
  model.set("_day", { key: [40, 0, "2024-06-01"], path });
  clock.moveTo(12);
  assert.equal(set[0].sun_elevation, 60);
  model.set("_day", { key: [41, 0, "2024-06-01"], path });
  assert.deepEqual(clock.path, []);
});

test("without a kernel its tools are disabled, say why, and come back as they were", () => {
  const tool = new Node("Set the horizon (2)");
  const kernel = { state: "lost", answers: false };
  const hand = new Hand({ answers: true });
  hand.tool = "horizon";
  const part = kernelRequired({
    hand,
    inspector: { choice: new Node(), map: null },
    kernel,
    panel: { node: new Node() },
    root: new Node(),
    state: { parameters: [] },
    toolbar: { tools: [{ value: "horizon", node: tool }], save: new Node() },
  });
  part.show();
  assert.deepEqual([tool.disabled, hand.tool], [true, "sun"]);
  assert.match(tool.title, /run the cell again/);
  kernel.state = "live";
  part.show();
  assert.deepEqual([tool.disabled, tool.title], [false, "Set the horizon (2)"]);
});

test("the stage tells how far the kernel is, and the message line what went wrong", () => {
  const told = [];
  const needs = {
    message: { show: (text) => told.push(text) },
    model: new FakeModel({ _status: { stage: "analysing", fraction: 0.5, message: "Sky" } }),
    root: new Node(),
    stage: { setProgress: (fraction) => told.push(fraction) },
  };
  showStatus(needs);
  needs.model.set("_status", { stage: "error", fraction: 0, message: "No photo" });
  showStatus(needs);
  assert.deepEqual(told, [0.5, null, "No photo"]);
  assert.equal(needs.root.dataset.stage, "error");
});
