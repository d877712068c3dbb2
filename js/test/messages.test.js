import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";
import { EditState } from "../src/edit/state.js";
import { Channel } from "../src/host/channel.js";
import { Notebook, randomOf } from "./notebook.js";

const SEEDS = 60;
const ACTIONS = 30;
const NAMES = ["sun_azimuth", "sun_elevation", "exposure"];
const parameters = NAMES.map((name) => ({ name, kind: "number", default: null }));
const STATE = {
  ...Object.fromEntries(NAMES.map((name) => [name, null])),
  _history: { past: [], future: [] },
  _versions: [],
  key_frames: [],
};

beforeEach(() => mock.timers.enable({ apis: ["setTimeout", "Date"] }));
afterEach(() => mock.timers.reset());

const settle = (notebook) => {
  for (let i = 0; i < 1000 && !notebook.quiet; i++) mock.timers.tick(50);
  mock.timers.tick(500);
  for (let i = 0; i < 1000 && !notebook.quiet; i++) mock.timers.tick(50);
  assert.ok(notebook.quiet, "the notebook never comes to rest");
};

/** Drag the sun; returns where it was let go. */
const drag = (state, random) => {
  let place = {};
  state.begin();
  for (let i = 0; i < 4; i++) {
    place = { sun_azimuth: random(), sun_elevation: random() };
    state.set(place);
    mock.timers.tick(150 * random());
    assert.equal(state.values.sun_azimuth, place.sun_azimuth, "the sun left the hand");
  }
  state.commit();
  return place;
};

/** What a person may do to an edit. */
const ACTS = {
  drag,
  slide: (state, random) => state.set({ exposure: random() }),
  undo: (state) => state.undo(),
  redo: (state) => state.redo(),
  reset: (state) => state.reset(),
  giveUp(state, random) {
    state.begin();
    state.set({ exposure: random() });
    mock.timers.tick(150 * random());
    state.cancel();
  },
};

const pick = (random, all) => all[Math.floor(random() * all.length)];

/** A notebook with two tabs, the first of which shows the editor twice. */
const open = (seed, faults = {}) => {
  const random = randomOf(seed);
  const notebook = new Notebook({ state: STATE, random, ...faults });
  const { signal } = new AbortController();
  const tabs = [notebook.model(), notebook.model()];
  const views = [tabs[0], ...tabs].map((model) => new EditState(model, parameters, signal));
  return { random, notebook, tabs, views };
};

const actAtRandom = (random, view) => {
  ACTS[pick(random, Object.keys(ACTS))](view, random);
  mock.timers.tick(random() < 0.3 ? 3000 * random() : 100 * random());
};

test("two tabs, two views and a cell agree at last, and what a person did last holds", () => {
  for (let seed = 0; seed < SEEDS; seed++) {
    const { random, notebook, tabs, views } = open(seed);
    let view = views[0];
    for (let i = 0; i < ACTIONS; i++) {
      if (random() < 0.2) notebook.set({ [pick(random, NAMES)]: random() });
      if (random() < 0.2) {
        settle(notebook); // a person needs a moment to go to another tab
        view = pick(random, views);
      }
      actAtRandom(random, view);
    }
    // What a cell has set just before is on its way here while the hand holds the sun.
    notebook.set({ sun_azimuth: random(), sun_elevation: random() });
    const { sun_azimuth, sun_elevation } = drag(view, random);
    settle(notebook);
    const [azimuth, elevation, exposure] = NAMES.map((name) => notebook.traits[name]);
    assert.deepEqual([azimuth, elevation], [sun_azimuth, sun_elevation], `seed ${seed}`);
    assert.equal(exposure, view.values.exposure, `seed ${seed}`);
    for (const { state } of tabs) assert.deepEqual(state, notebook.traits, `seed ${seed}`);
    for (const { values } of views) {
      for (const name of NAMES) assert.equal(values[name], notebook.traits[name], `seed ${seed}`);
    }
  }
});

test("every step that a person made can be gone back to, however late the kernel hears of it", () => {
  for (let seed = 0; seed < SEEDS; seed++) {
    const { random, notebook, views } = open(seed, { delay: 2000 });
    const made = [];
    for (let i = 0; i < ACTIONS; i++) {
      const view = pick(random, views.slice(0, 2)); // of one page
      actAtRandom(random, view);
      made.push(view.recipe());
    }
    settle(notebook);
    const { past, future } = notebook.traits._history;
    const [view] = views;
    const kept = [...past, view.recipe(), ...future].map((recipe) => JSON.stringify(recipe));
    // Undone and then drawn over, a branch is gone on purpose; what stands is not.
    assert.ok(kept.includes(JSON.stringify(made.at(-1))), `seed ${seed}`);
    while (view.history().past.length) view.undo();
    assert.deepEqual(view.recipe(), {}, `seed ${seed}`);
    for (let i = 0; i < past.length; i++) view.redo();
    settle(notebook);
    assert.deepEqual(view.recipe(), JSON.parse(kept[past.length]), `seed ${seed}`);
  }
});

test("whatever befalls its messages, a request ends", async () => {
  for (const faults of [{ shuffled: true }, { twice: 0.5 }, { lost: 0.3 }, { lost: 1 }]) {
    for (let seed = 0; seed < SEEDS; seed++) {
      const work = ({ number }) => {
        if (number % 5 === 0) throw new Error("The disk is full.");
        return number;
      };
      const { random, notebook, tabs } = open(seed, { ...faults, work });
      const { signal } = new AbortController();
      const channel = new Channel(pick(random, tabs), signal);
      const ended = [1, 2, 3, 4, 5].map((number) => {
        const stop = new AbortController();
        if (random() < 0.2) setTimeout(() => stop.abort(), 500 * random());
        return channel.request("still", { number }, undefined, [], stop.signal).then(
          ({ result }) => assert.equal(result, number),
          ({ message }) => assert.match(message, /disk is full|Canceled|is not responding/),
        );
      });
      settle(notebook);
      mock.timers.tick(200_000);
      await Promise.all(ended);
      assert.equal(channel.open.size, 0);
    }
  }
});
