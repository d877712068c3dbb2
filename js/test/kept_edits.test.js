import assert from "node:assert/strict";
import { test } from "node:test";
import { KeptEdits } from "../src/edit/kept_edits.js";

/** The part of Web Storage that is used, with room for so many characters. */
class FakeStorage {
  constructor(room = Infinity) {
    this.room = room;
    this.items = new Map();
  }
  get length() {
    return this.items.size;
  }
  key(i) {
    return [...this.items.keys()][i] ?? null;
  }
  getItem(key) {
    return this.items.get(key) ?? null;
  }
  removeItem(key) {
    this.items.delete(key);
  }
  setItem(key, text) {
    const others = [...this.items].filter(([name]) => name !== key);
    const used = others.reduce((sum, [name, value]) => sum + name.length + value.length, 0);
    if (used + key.length + text.length > this.room) throw new Error("QuotaExceededError");
    this.items.set(key, text);
  }
}

const entry = (session, saved, recipe = { exposure: saved }, past = [{}]) => ({
  session,
  saved,
  recipe,
  past,
  future: [],
  versions: [],
  keyFrames: [],
});
const keptIn = (storage) => new KeptEdits(() => storage);

test("each session of a photo has one entry, newest first", () => {
  const kept = keptIn(new FakeStorage());
  kept.put("a", entry("first", 1));
  kept.put("a", entry("second", 2));
  kept.put("a", entry("first", 3));
  assert.deepEqual(
    kept.of("a").map(({ session, saved }) => [session, saved]),
    [
      ["first", 3],
      ["second", 2],
    ],
  );
  assert.deepEqual(kept.of("b"), []);
  for (let i = 0; i < 10; i++) kept.put("a", entry(`session ${i}`, 10 + i));
  assert.equal(kept.of("a").length, 4);
});

test("an entry that is set aside is not written over by its session", () => {
  const kept = keptIn(new FakeStorage());
  kept.put("a", entry("first", 1));
  kept.setAside("a", "first");
  kept.put("a", entry("first", 2));
  assert.deepEqual(
    kept.of("a").map(({ recipe }) => recipe.exposure),
    [2, 1],
  );
});

test("dismissed entries stay", () => {
  const kept = keptIn(new FakeStorage());
  kept.put("a", entry("first", 1));
  kept.dismiss("a");
  assert.equal(kept.of("a")[0].dismissed, true);
});

test("the oldest photos go first, and other pages' items never", () => {
  const storage = new FakeStorage();
  storage.setItem("jupyterlab", "theme");
  const kept = keptIn(storage);
  for (let i = 0; i < 30; i++) kept.put(`photo ${i}`, entry("s", i));
  assert.equal(storage.length, 21);
  assert.deepEqual(kept.of("photo 9"), []);
  assert.equal(kept.of("photo 10").length, 1);
  assert.equal(storage.getItem("jupyterlab"), "theme");
});

test("a full storage keeps the edit and gives up old steps, then other photos", () => {
  const storage = new FakeStorage(3000);
  const kept = keptIn(storage);
  kept.put("old", entry("s", 1, { exposure: 1 }, []));
  const past = Array.from({ length: 100 }, (_, exposure) => ({ exposure, sun_elevation: 3.25159 }));
  kept.put("new", entry("s", 2, { exposure: 2 }, past));
  const [found] = kept.of("new");
  assert.equal(found.recipe.exposure, 2);
  assert.ok(found.past.length > 0 && found.past.length < 100);
  assert.deepEqual(found.past.at(-1), past.at(-1), "the last steps stay");
  assert.equal(kept.of("old").length, 1);
  storage.room = 300;
  storage.removeItem("sunwidget:edits:new");
  kept.put("new", entry("s", 3, { exposure: 3, long: "x".repeat(150) }, past));
  assert.equal(kept.of("new")[0].recipe.exposure, 3);
  assert.deepEqual(kept.of("old"), []);
});

test("no storage, no room at all and other versions' items are no errors", () => {
  const forbidden = new KeptEdits(() => {
    throw new Error("SecurityError");
  });
  const tiny = keptIn(new FakeStorage(10));
  for (const kept of [forbidden, tiny]) {
    kept.put("a", entry("s", 1));
    kept.dismiss("a");
    kept.setAside("a", "s");
    assert.deepEqual(kept.of("a"), []);
  }
  const storage = new FakeStorage();
  const wrong = ["{", "3", '{"a": 1}', '[3, null, {"recipe": 1}, {"session": "s", "recipe": []}]'];
  for (const text of wrong) {
    storage.setItem("sunwidget:edits:a", text);
    assert.deepEqual(keptIn(storage).of("a"), []);
  }
  storage.setItem(
    "sunwidget:edits:a",
    '[{"session": "s", "recipe": {}, "past": 3, "versions": [{}], "keyFrames": [{}]}]',
  );
  const [whole] = keptIn(storage).of("a");
  assert.deepEqual([whole.past, whole.future, whole.versions, whole.saved], [[], [], [], 0]);
  assert.deepEqual(whole.keyFrames, []);
});
