import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";
import { Kernel } from "../src/editor/view/kernel.js";
import { FakeModel } from "./fake_model.js";

const PATIENCE_MS = 15_000;

beforeEach(() => mock.timers.enable({ apis: ["setTimeout"] }));
afterEach(() => mock.timers.reset());

let greetings = 0; // what the last kernel was sent when it opened

const open = (state = {}) => {
  const model = new FakeModel(state);
  const kernel = new Kernel(model, new AbortController().signal);
  const told = [];
  kernel.onChange(() => told.push([kernel.state, kernel.silent]));
  greetings = model.sent.splice(0).length;
  return { model, kernel, told };
};

test("a kernel that says nothing for long is said to be silent until it reports itself", () => {
  const { model, kernel, told } = open();
  kernel.check();
  kernel.check(); // asked already
  assert.equal(model.sent.length, 1);
  mock.timers.tick(PATIENCE_MS + 1);
  assert.deepEqual(told, [["live", true]]);
  model.fire("msg:custom", { type: "response", id: "alive" });
  assert.deepEqual(told.at(-1), ["live", false]);
  kernel.check();
  assert.equal(model.sent.length, 2);
});

test("a kernel is spoken to at once, and not expected to answer soon: a cell may run", () => {
  const { told } = open();
  assert.equal(greetings, 1);
  mock.timers.tick(2 * PATIENCE_MS);
  assert.deepEqual(told, []);
});

test("without a connection the kernel is lost, and asked again when there is one", () => {
  const { model, kernel, told } = open();
  const { send } = model;
  kernel.check();
  model.send = () => {
    throw new Error("Not connected.");
  };
  model.fire("msg:custom", {});
  kernel.check();
  assert.equal(kernel.answers, false);
  mock.timers.tick(2 * PATIENCE_MS);
  assert.deepEqual(told, [["lost", false]]);
  model.send = send;
  model.fire("change:_scene");
  assert.equal(kernel.answers, true);
  kernel.check();
  assert.equal(model.sent.length, 2);
});

test("in a page without a kernel none is asked", () => {
  const { model, kernel } = open({ _standalone: true });
  kernel.check();
  model.fire("msg:custom", {});
  assert.deepEqual([kernel.state, kernel.follow], ["none", "never"]);
  assert.equal(model.sent.length + greetings, 0);
});
