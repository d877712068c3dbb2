import assert from "node:assert/strict";
import { test } from "node:test";
import { resolveIncludes } from "../src/gl/include.js";

const files = {
  "main.glsl": '#include "lib/a.glsl"\n#include "lib/b.glsl"\nvoid main() {}\n',
  "lib/a.glsl": '#include "lib/b.glsl"\nfloat a;\n',
  "lib/b.glsl": "float b;\n",
  "circle.glsl": '#include "circle.glsl"\nfloat c;\n',
};

test("a file is expanded at its first mention and dropped at later ones", () => {
  assert.equal(resolveIncludes(files, "main.glsl"), "float b;\n\nfloat a;\n\n\nvoid main() {}\n");
});

test("a file that includes itself ends", () => {
  assert.equal(resolveIncludes(files, "circle.glsl"), "\nfloat c;\n");
});

test("a missing file is named", () => {
  assert.throws(() => resolveIncludes({ "x.glsl": '#include "lib/no.glsl"' }, "x.glsl"), /lib\/no/);
});

test("a dollar sign in a library is text, not a pattern", () => {
  const odd = { "x.glsl": '#include "y.glsl"', "y.glsl": "// $& $1" };
  assert.equal(resolveIncludes(odd, "x.glsl"), "// $& $1");
});
