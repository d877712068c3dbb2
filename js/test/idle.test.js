import assert from "node:assert/strict";
import { test } from "node:test";
import { whenIdle } from "../src/host/idle.js";

test("work that waits for idleness is done at last, and can be forgotten", () => {
  /** @type {any[]} */
  const asked = [];
  /** @type {any} */
  const page = globalThis;
  page.requestIdleCallback = (/** @type {any[]} */ ...call) => asked.push(call);
  page.cancelIdleCallback = (/** @type {number} */ id) => asked.splice(id - 1, 1);
  const work = () => {};
  const forget = whenIdle(work);
  assert.equal(asked[0][0], work);
  assert.ok(asked[0][1].timeout > 0);
  forget();
  assert.deepEqual(asked, []);
  delete page.requestIdleCallback;
  delete page.cancelIdleCallback;
});
