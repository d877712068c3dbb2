import assert from "node:assert/strict";
import { test } from "node:test";
import { keyNames, matches, runShortcut } from "../src/ui/keys.js";

/** A key press on an element that is met by the given selectors' parts. */
function press(key, { on = "div", altGraph = false, ...modifiers } = {}) {
  const event = {
    key,
    ctrlKey: false,
    metaKey: false,
    shiftKey: false,
    altKey: false,
    defaultPrevented: false,
    isComposing: false,
    target: { matches: (selector) => selector.split(",").some((part) => part.trim() === on) },
    getModifierState: (name) => name === "AltGraph" && altGraph,
    preventDefault() {
      event.defaultPrevented = true;
    },
    stopPropagation() {},
    ...modifiers,
  };
  return event;
}

/** Which rows run, in order. */
function run(event, keys = ["B", "Mod+Z", "Mod+Shift+Z", "ArrowUp", "Space", "Escape"]) {
  const ran = [];
  const rows = keys.map((key) => ({ keys: [key], run: () => void ran.push(key) }));
  runShortcut(rows, null, event);
  return ran;
}

test("a key means its row, with its modifiers and no others", () => {
  assert.deepEqual(run(press("b")), ["B"]);
  assert.deepEqual(run(press("B", { shiftKey: true })), []);
  assert.deepEqual(run(press("b", { altKey: true })), []);
  assert.deepEqual(run(press("z", { ctrlKey: true })), ["Mod+Z"]);
  assert.deepEqual(run(press("z", { metaKey: true })), ["Mod+Z"]);
  assert.deepEqual(run(press("Z", { ctrlKey: true, shiftKey: true })), ["Mod+Shift+Z"]);
  assert.deepEqual(run(press(" ")), ["Space"]);
});

test("a sign is met however the keyboard makes it", () => {
  assert.ok(matches("?", press("?", { shiftKey: true })));
  assert.ok(matches("?", press("?")));
  assert.ok(matches("[", press("[", { ctrlKey: true, altKey: true, altGraph: true })));
  assert.ok(!matches("[", press("[", { ctrlKey: true })));
  assert.ok(matches("+", press("+")));
  assert.ok(matches("Mod++", press("+", { ctrlKey: true })));
  assert.ok(!matches("Mod++", press("+")));
});

test("the control with the focus keeps the keys that it needs", () => {
  const slider = { on: 'input[type="range"]' };
  assert.deepEqual(run(press("ArrowUp", slider)), []);
  assert.deepEqual(run(press("b", slider)), ["B"]);
  assert.deepEqual(run(press("z", { ...slider, ctrlKey: true })), ["Mod+Z"]);
  assert.deepEqual(run(press(" ", { on: "button" })), []);
  assert.deepEqual(run(press("ArrowUp", { on: "button" })), ["ArrowUp"]);
  assert.deepEqual(run(press("b", { on: "select" })), []);
  for (const key of ["b", "Escape"]) assert.deepEqual(run(press(key, { on: "textarea" })), []);
  assert.deepEqual(run(press("z", { on: "textarea", ctrlKey: true })), []);
});

test("a row that has nothing to do leaves the key to the next, and to the host", () => {
  const event = press("Escape");
  const ran = [];
  const row = (name, answer) => ({ keys: ["Escape"], run: () => ran.push(name) && answer });
  runShortcut([row("first", false), row("second"), row("third")], null, event);
  assert.deepEqual(ran, ["first", "second"]);
  assert.ok(event.defaultPrevented);
  const free = press("Escape");
  runShortcut([row("first", false), { keys: ["Escape"] }], null, free);
  assert.ok(!free.defaultPrevented);
});

test("keys are written as they are printed", () => {
  assert.deepEqual(keyNames("Mod+Shift+Z", false), ["Ctrl", "Shift", "Z"]);
  assert.deepEqual(keyNames("Mod+0", true), ["⌘", "0"]);
  assert.deepEqual(keyNames("Mod++", false), ["Ctrl", "+"]);
  assert.deepEqual(keyNames("ArrowLeft", false), ["←"]);
});
