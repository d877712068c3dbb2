import assert from "node:assert/strict";
import { test } from "node:test";
import { stripComments } from "../build.mjs";

test("comments go, lines stay, so that compilers' line numbers are true", () => {
  const text = "a; // one\n/* two\n three */ b;\n  c;\n";
  assert.equal(stripComments(text), "a;\n\nb;\nc;\n");
});
