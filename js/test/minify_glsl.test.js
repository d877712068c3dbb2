import assert from "node:assert/strict";
import { test } from "node:test";
import { readShaders } from "../build.mjs";
import { minify, shortNumber, stripComments } from "../minify_glsl.mjs";

const one = (text) => minify({ "a.glsl": text })["a.glsl"];

test("comments go, lines stay, so that compilers' line numbers are true", () => {
  const text = "a; // one\n/* two\n three */ b;\n  c;\n";
  assert.equal(stripComments(text), "a;\n\nb;\nc;\n");
  assert.equal(one(text), "a;\n\nb;\nc;\n");
});

test("blanks go where they mean nothing, and only there", () => {
  assert.equal(
    one("float f() {\n  if (a < b && !c) return a - -b + ++c;\n}"),
    "float A(){\nif(a<b&&!c)return a- -b+ ++c;\n}",
  );
  assert.equal(one("return .5;"), "return .5;");
  assert.throws(() => one("#define TWO(a) \\\n (2.0 * a)\n"), /on one line: "#define TWO/);
  assert.equal(one("#define HALF (0.5)\n#if A == 1\n"), "#define HALF (0.5)\n#if A == 1\n");
});

test("numbers lose the digits that say nothing, and stay what they are", () => {
  const short = {
    "1.0": "1.",
    "0.50": ".5",
    "0.0": "0.",
    10: "10",
    "1.0e-3": "1e-3",
    "2.50e8": "2.5e8",
  };
  for (const [long, expected] of Object.entries({
    ...short,
    "1e6": "1e6",
    "16777216.0": "16777216.",
    "7u": "7u",
  })) {
    assert.equal(shortNumber(long), expected);
    assert.equal(Number.parseFloat(expected), Number.parseFloat(long));
  }
});

test("names of the top level are the same in all files, those of functions are their own", () => {
  const small = minify({
    "lib.glsl": "const float kHalf = 0.5;\nfloat Half(float number) { return kHalf * number; }",
    "main.glsl": "uniform float share;\nvoid main() { float whole = share, part = Half(whole); }",
  });
  assert.equal(small["lib.glsl"], "const float B=.5;\nfloat A(float a){return B*a;}");
  assert.equal(small["main.glsl"], "uniform float share;\nvoid main(){float a=share,b=A(a);}");
});

test("parameters are each declared for themselves", () => {
  assert.equal(
    one("bool Hits(vec2 place, out vec3 way, const in float far) { return far > 0.0; }"),
    "bool A(vec2 a,out vec3 b,const in float c){return c>0.;}",
  );
});

test("what others know by name keeps it", () => {
  const text = [
    "#define SWITCH 1",
    "uniform vec3 first, second;",
    "struct Ray { vec3 origin; };",
    "Ray Make(vec3 first_of, vec3 origin) { Ray made; made.origin = origin; return made; }",
    "float distance_of(vec3 a, vec3 b) { float distance = distance(a, b); return distance; }",
    "void SetConstants() {}",
    "void main() { int SWITCH_ON = SWITCH; vec3 rgb = first.rgb + second; }",
  ].join("\n");
  const lines = one(text).split("\n");
  assert.equal(lines[1], "uniform vec3 first,second;");
  assert.match(lines[2], /^struct \w\{vec3 origin;\};$/);
  assert.match(lines[3], /^(\w) \w\(vec3 a,vec3 origin\)\{\1 b;b\.origin=origin;return b;\}$/);
  assert.match(lines[4], /\{float distance=distance\(a,b\);return distance;\}/);
  assert.equal(lines[5], "void SetConstants(){}");
  assert.equal(lines[6], "void main(){int a=SWITCH;vec3 rgb=first.rgb+second;}");
});

test("another word for a type is the type", () => {
  const small = minify({
    "a.glsl": "#define Length float\n",
    "b.glsl": "Length Of(Length h) { return h; }",
  });
  assert.deepEqual(small, { "a.glsl": "\n", "b.glsl": "float A(float a){return a;}" });
});

/** Words and numbers of a text in order, without what a directive says. */
const words = (text) => text.replace(/^#.*$/gm, "").match(/[A-Za-z_]\w*|[^\sA-Za-z_]/g) ?? [];

test("every shader says the same in other words: as many, and each new one for one old one", () => {
  const files = readShaders();
  const small = minify(files);
  /** @type {Map<string, string>} */
  const top = new Map();
  for (const [path, text] of Object.entries(files)) {
    const plain = stripComments(text).replace(/[ \t]+/g, " ");
    assert.equal(small[path].split("\n").length, text.split("\n").length, path);
    const numbers = /(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/g;
    const values = (/** @type {string} */ of) => (of.match(numbers) ?? []).map(Number);
    assert.deepEqual(values(small[path]), values(plain), path);
    const before = words(plain.replace(numbers, "0"));
    const after = words(small[path].replace(numbers, "0"));
    assert.equal(after.length, before.length, path);
    for (const [i, now] of after.entries()) {
      // Names with a capital at their end are the top level's, in all files together.
      if (now === before[i] || !/[A-Z]$/.test(now)) continue;
      assert.equal(top.get(now) ?? before[i], before[i], `${path}: ${now}`);
      top.set(now, before[i]);
    }
  }
  assert.ok(top.size > 300);
  assert.equal(new Set(top.values()).size, top.size);
});
