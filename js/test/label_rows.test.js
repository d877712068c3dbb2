import assert from "node:assert/strict";
import { test } from "node:test";
import { labelRows } from "../src/editor/panel/label_rows.js";

test("labels with room stay, others go down just so far that none lies on another", () => {
  assert.deepEqual(labelRows([100, 50, 200], 13), [100, 50, 200]);
  assert.deepEqual(labelRows([104, 100, 100], 13), [126, 100, 113]);
  assert.deepEqual(labelRows([], 13), []);
});
