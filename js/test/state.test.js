import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { HISTORY_BYTES, HISTORY_LENGTH } from "../src/edit/history_limit.js";
import { EditState } from "../src/edit/state.js";
import { FakeModel } from "./fake_model.js";

const parameters = [
  { name: "sun_elevation", kind: "number", default: null },
  { name: "exposure", kind: "number", default: 0 },
  { name: "strokes", kind: "data", default: [] },
];

let model;
let state;
beforeEach(() => {
  model = new FakeModel({
    sun_elevation: null,
    exposure: 0,
    strokes: [],
    _history: { past: [], future: [] },
    _versions: [],
  });
  state = new EditState(model, parameters, new AbortController().signal);
});

test("a drag is one step, whatever lies between", () => {
  state.begin();
  for (const value of [1, 2, 3]) state.set({ sun_elevation: value });
  state.commit();
  assert.equal(model.get("sun_elevation"), 3);
  assert.deepEqual(model.get("_history").past, [{}]);
});

test("while a drag lasts the traits are throttled, the view's values are not", () => {
  state.begin();
  state.set({ sun_elevation: 1 });
  state.set({ sun_elevation: 2 });
  assert.equal(model.get("sun_elevation"), null);
  assert.equal(state.values.sun_elevation, 2);
  state.commit();
  assert.equal(model.get("sun_elevation"), 2);
  assert.equal(model.saves, 1);
});

test("a drag that ends where it began is no step", () => {
  state.begin();
  state.set({ exposure: 1 });
  state.set({ exposure: 0 });
  state.commit();
  assert.deepEqual(model.get("_history").past, []);
});

test("undo and redo return the very values", () => {
  state.set({ sun_elevation: 3.1234 });
  state.set({ exposure: -0.35 });
  const last = structuredClone(state.values);
  state.undo();
  assert.deepEqual(state.values, { sun_elevation: 3.1234, exposure: 0, strokes: [] });
  state.undo();
  assert.deepEqual(state.values, { sun_elevation: null, exposure: 0, strokes: [] });
  state.undo();
  state.redo();
  state.redo();
  assert.deepEqual(state.values, last);
  assert.deepEqual(model.get("_history").future, []);
});

test("a new step ends the branch that was undone", () => {
  state.set({ exposure: 1 });
  state.undo();
  state.set({ exposure: 2 });
  assert.deepEqual(model.get("_history").future, []);
});

test("reset is one step and takes strokes along", () => {
  state.set({ strokes: [{ label: "sky", points: [[0, 0]], radius: 0.01 }], exposure: 1 });
  state.reset();
  assert.deepEqual(state.recipe(), {});
  state.undo();
  assert.equal(state.values.strokes.length, 1);
});

test("what Python sets is taken over, but not over an unfinished drag", () => {
  model.set("exposure", 0.5);
  assert.equal(state.values.exposure, 0.5);
  state.begin();
  state.set({ exposure: 1 });
  model.set("exposure", 0.7);
  assert.equal(state.values.exposure, 1);
});

test("what comes late does not pull a value out of the hand, and the hand's is sent at the end", () => {
  state.begin();
  state.set({ exposure: 1 });
  state.push();
  model.set("exposure", 0.3); // an older move, from another view or a slow host
  model.set("sun_elevation", 5);
  assert.equal(state.values.exposure, 1);
  assert.equal(state.values.sun_elevation, 5);
  state.commit();
  assert.equal(model.get("exposure"), 1);
  model.set("exposure", 0.6);
  assert.equal(state.values.exposure, 0.6);
});

test("cancel returns to where the gesture began and leaves no step", () => {
  state.begin();
  state.set({ exposure: 1 });
  state.cancel();
  assert.equal(state.values.exposure, 0);
  assert.deepEqual(model.get("_history").past, []);
});

test("long strokes do not make the history too large to send", () => {
  const points = Array.from({ length: 2000 }, (_, i) => [i / 2000, 0.1234]);
  let strokes = [];
  for (let i = 0; i < 40; i++) {
    strokes = [...strokes, { label: "sky", points, radius: 0.01 }];
    state.set({ strokes });
  }
  const { past } = model.get("_history");
  assert.ok(past.length > 0);
  assert.ok(JSON.stringify(past).length < 1.1 * HISTORY_BYTES);
  assert.equal(past.at(-1).strokes.length, 39);
});

test("the history has an end", () => {
  for (let i = 1; i <= HISTORY_LENGTH + 20; i++) state.set({ exposure: i });
  assert.equal(model.get("_history").past.length, HISTORY_LENGTH);
});

test("what the photo's maps follow is said when it is sent, and nothing else", () => {
  const marked = parameters.map((p) => ({ ...p, analysis: p.name === "strokes" }));
  const other = new EditState(model, marked, new AbortController().signal);
  let said = 0;
  other.onCorrection = () => {
    said += 1;
  };
  other.set({ exposure: 1 });
  assert.equal(said, 0);
  other.set({ strokes: [{ label: "sky", points: [[0, 0]], radius: 0.01 }] });
  assert.equal(said, 1);
  other.undo();
  assert.equal(said, 2);
});

test("a closed view hears no more", () => {
  const controller = new AbortController();
  const closed = new EditState(model, parameters, controller.signal);
  controller.abort();
  model.set("exposure", 2);
  assert.equal(closed.values.exposure, 0);
});

const strokes = [{ label: "sky", points: [[0, 0]], radius: 0.01 }];

function following(when) {
  const marked = parameters.map((p) => ({ ...p, analysis: p.name === "strokes" }));
  const other = new EditState(model, marked, new AbortController().signal);
  other.follow = () => when;
  return other;
}

test("without a kernel nobody corrects the maps; what was kept comes back whole all the same", () => {
  const lost = following("later");
  lost.set({ strokes, exposure: 1 });
  assert.deepEqual(lost.recipe(), { exposure: 1 });
  lost.restore({ recipe: { strokes }, past: [], future: [], versions: [], keyFrames: [] });
  assert.deepEqual(lost.recipe(), { strokes });
  const page = following("never");
  page.apply({ exposure: 2 });
  assert.deepEqual(page.recipe(), { exposure: 2, strokes }, "the page's maps stay as they are");
});

test("a replaced recipe is one step, and none when it changes nothing", () => {
  state.replace({ exposure: 1, sun_elevation: 3 });
  state.replace({ exposure: 1, sun_elevation: 3 });
  assert.deepEqual(model.get("_history").past, [{}]);
  state.undo();
  assert.deepEqual(state.recipe(), {});
});

test("undo in the middle of a drag gives the drag up, and no step more", () => {
  state.set({ exposure: 1 });
  state.begin();
  state.set({ exposure: 2 });
  state.undo();
  assert.deepEqual(state.recipe(), { exposure: 1 });
  assert.deepEqual(model.get("_history").past, [{}]);
});

test("what is kept in the middle of a drag can be undone later", () => {
  state.set({ exposure: 1 });
  state.begin();
  state.set({ exposure: 2 });
  assert.deepEqual(state.kept(), {
    recipe: { exposure: 2 },
    past: [{}, { exposure: 1 }],
    future: [],
    versions: [],
    keyFrames: [],
  });
  assert.deepEqual(model.get("_history").past, [{}], "the drag itself goes on");
});

test("what was kept comes back as it was over an untouched photo", () => {
  const kept = {
    recipe: { exposure: 2 },
    past: [{}, { exposure: 1 }],
    future: [{ exposure: 3 }],
    versions: [{ name: "warm", recipe: { exposure: 1 } }],
    keyFrames: [{ seconds: 2, recipe: { exposure: 3 } }],
  };
  state.restore(kept);
  assert.deepEqual(state.kept(), kept);
  state.redo();
  assert.deepEqual(state.recipe(), { exposure: 3 });
});

test("what was kept never wipes out what is there", () => {
  model.set("_versions", [{ name: "warm", recipe: { exposure: 9 } }]);
  state.set({ exposure: 5 });
  state.set({ exposure: 6 });
  const versions = [
    { name: "warm", recipe: {} },
    { name: "cold", recipe: {} },
  ];
  const keyFrames = [{ seconds: 1, recipe: { exposure: 7 } }];
  model.set("key_frames", keyFrames);
  const other = [{ seconds: 9, recipe: {} }];
  const past = [{ exposure: 1 }];
  state.restore({ recipe: { exposure: 2 }, past, future: [], versions, keyFrames: other });
  assert.deepEqual(state.keyFrames(), keyFrames);
  assert.deepEqual(state.recipe(), { exposure: 2 });
  assert.deepEqual(
    state.history().past.map(({ exposure = 0 }) => exposure),
    [1, 0, 5, 6],
  );
  assert.deepEqual(
    state.versions().map(({ name, recipe }) => [name, recipe.exposure]),
    [
      ["warm", 9],
      ["cold", undefined],
    ],
  );
  state.undo();
  assert.deepEqual(state.recipe(), { exposure: 6 });
});

test("another photo in the middle of a drag takes nothing of the drag over", () => {
  state.begin();
  state.set({ sun_elevation: 8 });
  model.set("sun_elevation", null);
  state.abandon();
  assert.equal(state.values.sun_elevation, null);
  state.set({ exposure: 1 });
  assert.equal(model.get("sun_elevation"), null);
  assert.deepEqual(model.get("_history").past, [{}]);
});
