/** Print every shader file's text with includes expanded, for the test that compares both hosts. */
import { readShaders } from "../build.mjs";
import { resolveIncludes } from "../src/gl/include.js";

const files = readShaders();
const passes = Object.keys(files);
const expanded = Object.fromEntries(passes.map((name) => [name, resolveIncludes(files, name)]));
process.stdout.write(JSON.stringify(expanded));
