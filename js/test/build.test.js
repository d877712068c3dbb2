import assert from "node:assert/strict";
import { test } from "node:test";
import { compact, inlined, reachable, renamed } from "../build.mjs";

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

test("a shader loses comments, blanks and zeros at the point; what it says, and each line of the preprocessor, stays", () => {
  const text = `// one
#define TWICE(x) (2.0 * x) // two

  /* three
     lines */ vec3 a = vec3(1.0, -2.0,  3.0) / b;
    return a - -b + 0.50 * c10.0 + (20.05) - d;  // four
#include "lib/c.glsl"
`;
  assert.equal(
    compact(text),
    `#define TWICE(x) (2.0 * x)
vec3 a=vec3(1.,-2.,3.)/b;
return a- -b+.50*c10.0+(20.05)-d;
#include "lib/c.glsl"`,
  );
});

test("a wrapped statement becomes one line, and preprocessor lines stay lines", () => {
  const text =
    "#if A\nfloat f(float a,\n        float b) {\n  return a\n      + b;  // sum\n}\n#endif\nvec2 c\n#if B\n= d\n#endif\n;";
  assert.equal(
    compact(text),
    "#if A\nfloat f(float a,float b){\nreturn a+b;}\n#endif\nvec2 c\n#if B\n=d\n#endif\n;",
  );
});

test("neighboring uniforms of one type are declared together", () => {
  const text =
    "uniform float a;\nuniform float b;  // meters\nuniform vec2 c;\nuniform vec2 d;\nuniform vec2 e;\n#if A\nuniform vec2 f;\n";
  assert.equal(compact(text), "uniform float a,b;\nuniform vec2 c,d,e;\n#if A\nuniform vec2 f;");
});

test("a closing brace stays below a preprocessor line", () => {
  assert.equal(
    compact("void f() {\n#if A\n  g();\n#endif\n}\n"),
    "void f(){\n#if A\ng();\n#endif\n}",
  );
});

test("neighboring variables of one type are declared together, whatever they begin with", () => {
  const text =
    "void f() {\n  float a = g(1.0, 2.0);\n  float b = a;\n  vec2 c = vec2(b);\n  vec2 d;\n  a = b;\n  float e = a;\n}\nfloat g(float a);\n";
  assert.equal(
    compact(text),
    "void f(){\nfloat a=g(1.,2.),b=a;\nvec2 c=vec2(b),d;\na=b;\nfloat e=a;}\nfloat g(float a);",
  );
});

test("constants become numbers where that is shorter; of two with one name neither does", () => {
  const texts = {
    "a.glsl":
      "const float kOnce=.5;\nconst float kTwice=2.12345678;\nconst float kOften=2.123456789;\nconst int kShort=3;\nconst float kNegative=-1.;\nconst vec2 kPair=vec2(1.,-2.);\nconst float kSame=1.;\nfloat f(vec2 x){\nconst float local=1.;\nreturn local*x.x-kOnce*kTwice+kTwice-kNegative*dot(kPair,x)+float(kShort)*kSame+kOften+kOften*kOften-kOften*kOften*kOften*kOften*kOften;}",
    "b.glsl":
      "const float kSame=2.;\nconst float kList[2]=float[2](1.,2.);\nfloat g(){return float(kShort)*kSame*kList[1];}",
    "c.glsl": "const float kList=4.;\nfloat h(){return kList;}",
  };
  assert.deepEqual(inlined(texts), {
    "a.glsl":
      "const float kOften=2.123456789;\nconst float kSame=1.;\nfloat f(vec2 x){\nconst float local=1.;\nreturn local*x.x-.5*2.12345678+2.12345678-(-1.)*dot(vec2(1.,-2.),x)+float(3)*kSame+kOften+kOften*kOften-kOften*kOften*kOften*kOften*kOften;}",
    "b.glsl":
      "const float kSame=2.;\nconst float kList[2]=float[2](1.,2.);\nfloat g(){return float(3)*kSame*kList[1];}",
    "c.glsl": "const float kList=4.;\nfloat h(){return kList;}",
  });
});

test("functions get short names, the same in every file; structs, uniforms and names in use stay", () => {
  const texts = {
    "lib.glsl":
      "uniform float Level;\nstruct Stops{\nfloat day;};\nfloat GetDay(float F0){\nreturn F0*Level;}",
    "a.glsl":
      '#include "lib.glsl"\nStops GetStops(){\nreturn Stops(GetDay(1.));}\nvoid SetConstants(){\nGetStops();}',
  };
  assert.deepEqual(renamed(texts), {
    "lib.glsl":
      "uniform float Level;\nstruct Stops{\nfloat day;};\nfloat F1(float F0){\nreturn F0*Level;}",
    "a.glsl":
      '#include "lib.glsl"\nStops F2(){\nreturn Stops(F1(1.));}\nvoid SetConstants(){\nF2();}',
  });
});
