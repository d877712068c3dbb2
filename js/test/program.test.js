import assert from "node:assert/strict";
import { test } from "node:test";
import { explain } from "../src/gl/program.js";

const text = ["one", "two", "three", "four", "five", "six"].join("\n");

test("a compiler's message is shown with the line it names", () => {
  const shown = explain("ERROR: 0:4: 'x' : undeclared identifier\0", text);
  assert.match(shown, /undeclared identifier/);
  assert.match(shown, /> {4}4 \| four/);
  assert.match(shown, / {5}2 \| two/);
  assert.doesNotMatch(shown, /one/);
});

test("Mesa's own form of message is understood too", () => {
  assert.match(explain("0:2(7): error: syntax", text), /> {4}2 \| two/);
});

test("a message without a line stays as it is", () => {
  assert.equal(explain("internal error", text), "internal error");
});
