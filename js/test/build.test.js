import assert from "node:assert/strict";
import { test } from "node:test";
import { reachable, stripComments } from "../build.mjs";

test("a bundle holds what its graph reaches, libraries of libraries too, and no more", () => {
  const files = {
    "a.glsl": '#include "lib/b.glsl"\nA',
    "lib/b.glsl": '  #include "lib/c.glsl"\n// #include "lib/no.glsl"\nB',
    "lib/c.glsl": '#include "lib/b.glsl"\nC',
    "once.glsl": '#include "lib/c.glsl"\nD',
    "other.glsl": "O",
  };
  const graph = { passes: [{ shader: "a" }, { shader: "a", constants: "once" }] };
  assert.deepEqual(reachable(graph, files), ["a.glsl", "lib/b.glsl", "lib/c.glsl", "once.glsl"]);
  assert.throws(() => reachable({ passes: [{ shader: "gone" }] }, files), /gone\.glsl/);
});

test("comments go, lines stay, so that compilers' line numbers are true", () => {
  const text = "a; // one\n/* two\n three */ b;\n  c;\n";
  assert.equal(stripComments(text), "a;\n\nb;\nc;\n");
});
