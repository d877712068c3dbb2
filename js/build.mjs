/**
 * Build the front end into `sunwidget/static/`. `--watch` rebuilds on change.
 *
 * The shaders and the frame graph are bundled as text, so that the browser's preview and the kernel's
 * exports use the same passes.
 */

import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { context } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const shaders = join(here, "..", "sunwidget", "shaders");
const out = join(here, "..", "sunwidget", "static");
const watching = process.argv.includes("--watch");

/** Read every shader's text, by its path relative to `shaders/`. */
export function readShaders() {
  /** @type {Record<string, string>} */
  const files = {};
  for (const entry of readdirSync(shaders, { recursive: true, withFileTypes: true })) {
    if (!entry.isFile() || !entry.name.endsWith(".glsl")) continue;
    const path = join(entry.parentPath, entry.name);
    const name = path.slice(shaders.length + 1).replaceAll("\\", "/");
    files[name] = readFileSync(path, "utf-8");
  }
  return files;
}

/** Shader modules by name, and the graph file of each in `shaders/`. */
const GRAPHS = { editor: "graph.json", explorer: "explorer.json" };

/**
 * Return the files that a graph's passes include.
 *
 * @param {{ passes: import("./src/gl/graph.js").Pass[] }} graph
 * @param {Record<string, string>} files text by path
 * @returns {string[]} paths, sorted
 */
export function reachable(graph, files) {
  const pending = graph.passes
    .flatMap(({ shader, constants, parts, format }) => [
      shader,
      constants,
      // The browser draws only the canvas's pass in parts.
      ...(parts && format === "output" ? [parts.by, ...parts.shaders] : []),
    ])
    .flatMap((name) => (name ? [`${name}.glsl`] : []));
  const found = new Set(pending);
  for (const path of pending) {
    if (files[path] === undefined) throw new Error(`There is no shader file "${path}".`);
    for (const [, name] of files[path].matchAll(/^[ \t]*#include "([^"]+)"[ \t]*$/gm)) {
      if (!found.has(name)) pending.push(name);
      found.add(name);
    }
  }
  return [...found].sort();
}

/**
 * Strip comments, indentation, empty lines, spaces around operators and zeros beside a decimal point from a
 * shader, make wrapped statements one line, put braces on the lines beside them, and declare neighbors of one type together. Other lines
 * stay: a driver's error quotes a line, which can be found in the file. (Some constants become numbers: `inlined`; functions get short
 * names: `renamed`.)
 *
 * @param {string} text
 */
export function compact(text) {
  return text
    .replace(/\/\*[\s\S]*?\*\/|\/\/.*/g, " ")
    .replace(/\s*\n\s*/g, "\n")
    .replace(/(?<=^(?!#).*[^;{}\n])\n(?!#)/gm, " ")
    .replace(/(?<=^(?!#).*)\n(?=\})/gm, "")
    .trim()
    .replace(/^[^#].*/gm, (line) =>
      line
        .replace(/ *([*/=<>(){}[\],;?:&|!]) */g, "$1")
        .replace(/(?<=[\w).\]]) ?([+-]) ?(?![+-])/g, "$1")
        .replace(/(?<![\w.])0(?=\.\d)/g, "") // 0.5 is .5, and 1.0 is 1.
        .replace(/(?<=(?<![\w.])\d+\.)0(?!\d)/g, ""),
    )
    .replace(
      /^((?:uniform )?(?:float|int|[iu]?vec[234]|sampler2D) )\w+(?:=[^;]+)?(;\n\1\w+(?:=[^;]+)?)+(?=;)/gm,
      (lines, type) => lines.replaceAll(`;\n${type}`, ","),
    );
}

const CONSTANT = /^const (?:float|int|vec[234]) (k[A-Z]\w*)=(-?[\d.e]+|vec[234]\([^();]*\));\n/gm;

/**
 * Put the numbers of constants in their place where that is shorter.
 *
 * @param {Record<string, string>} texts compact shaders by path
 */
export function inlined(texts) {
  /** @type {Map<string, number>} */
  const uses = new Map();
  /** @type {Map<string, string>} */
  const values = new Map();
  /** @type {Set<string>} */
  const declared = new Set();
  /** @type {Set<string>} */
  const twice = new Set();
  for (const text of Object.values(texts)) {
    for (const [name] of text.matchAll(/\b[a-zA-Z_]\w*/g))
      uses.set(name, (uses.get(name) ?? 0) + 1);
    for (const [, name, value] of text.matchAll(CONSTANT))
      values.set(name, value.startsWith("-") ? `(${value})` : value);
    for (const [, name] of text.matchAll(/^const \w+ (k[A-Z]\w*)/gm)) {
      // Of two constants with one name neither is known.
      if (declared.has(name)) twice.add(name);
      declared.add(name);
    }
  }
  for (const name of twice) values.delete(name);
  for (const [name, value] of values) {
    const places = Number(uses.get(name)) - 1;
    const line = `const float ${name}=${value};\n`.length;
    if (places * value.length > places * name.length + line) values.delete(name);
  }
  return Object.fromEntries(
    Object.entries(texts).map(([path, text]) => [
      path,
      text
        .replace(CONSTANT, (line, name) => (values.has(name) ? "" : line))
        .replace(/\bk[A-Z]\w*/g, (name) => values.get(name) ?? name),
    ]),
  );
}

const FUNCTION = /^\w+ ([A-Z]\w{3,})\((?=[^;{]*\)\{)/gm;
const WORD = /\b[A-Za-z_]\w*/g;
/** `gl/program.js` calls it by name. */
const CALLED = "SetConstants";

/**
 * Give functions short names, the same in every file. Uniforms, constants and what the front end calls keep theirs.
 *
 * @param {Record<string, string>} texts compact shaders by path
 */
export function renamed(texts) {
  const all = Object.values(texts).join("\n");
  const taken = new Set(all.match(WORD));
  const names = new Set([...all.matchAll(FUNCTION)].map(([, name]) => name));
  names.delete(CALLED);
  /** @type {Map<string, string>} */
  const short = new Map();
  let count = 0;
  for (const name of names) {
    let next;
    do next = `F${(count++).toString(36)}`;
    while (taken.has(next));
    short.set(name, next);
  }
  return Object.fromEntries(
    Object.entries(texts).map(([path, text]) => [
      path,
      text.replace(WORD, (word) => short.get(word) ?? word),
    ]),
  );
}

/** @type {import("esbuild").Plugin} */
export const shaderPlugin = {
  name: "sunwidget-shaders",
  setup(build) {
    build.onResolve({ filter: /^sunwidget:shaders\// }, ({ path }) => ({
      path,
      namespace: "glsl",
    }));
    build.onLoad({ filter: /.*/, namespace: "glsl" }, ({ path }) => {
      const name = /** @type {keyof typeof GRAPHS} */ (path.split("/")[1]);
      const graph = JSON.parse(readFileSync(join(shaders, GRAPHS[name]), "utf-8"));
      const files = readShaders();
      const reached = Object.fromEntries(
        reachable(graph, files).map((path) => [path, files[path]]),
      );
      // Keep comments while working on shaders.
      const texts = watching
        ? reached
        : renamed(
            inlined(
              Object.fromEntries(Object.entries(reached).map(([p, text]) => [p, compact(text)])),
            ),
          );
      return {
        contents:
          `export const files = ${JSON.stringify(texts)};\n` +
          `export const graph = ${JSON.stringify(graph)};\n`,
        loader: "js",
        watchDirs: readdirSync(shaders, { withFileTypes: true })
          .filter((entry) => entry.isDirectory())
          .map(({ name }) => join(shaders, name))
          .concat(shaders),
      };
    });
  },
};

/**
 * Add uPlot's license as a comment that esbuild keeps.
 *
 * @type {import("esbuild").Plugin}
 */
const licensePlugin = {
  name: "sunwidget-license",
  setup(build) {
    build.onLoad({ filter: /uPlot\.esm\.js$/ }, ({ path }) => {
      const license = readFileSync(join(dirname(path), "..", "LICENSE"), "utf-8");
      return { contents: `/*! uPlot\n${license.trim()}\n*/\n${readFileSync(path, "utf-8")}` };
    });
  },
};

async function main() {
  const build = await context({
    entryPoints: [
      { in: join(here, "src", "editor", "index.js"), out: "sun_editor" },
      { in: join(here, "src", "editor", "style.css"), out: "sun_editor" },
      { in: join(here, "src", "explorer", "index.js"), out: "sky_explorer" },
      { in: join(here, "src", "explorer", "style.css"), out: "sky_explorer" },
      { in: join(here, "src", "compare", "index.js"), out: "compare" },
      { in: join(here, "src", "compare", "style.css"), out: "compare" },
      { in: join(here, "src", "study", "index.js"), out: "study" },
      { in: join(here, "src", "study", "style.css"), out: "study" },
      { in: join(here, "src", "standalone", "index.js"), out: "standalone" },
    ],
    outdir: out,
    bundle: true,
    minify: true,
    format: "esm",
    target: "es2022",
    logLevel: "info",
    legalComments: "inline",
    // Beside the bundle but not referenced in it: a notebook cannot fetch it.
    sourcemap: "external",
    plugins: [shaderPlugin, licensePlugin],
  });
  if (watching) {
    await build.watch();
    return;
  }
  await build.rebuild();
  await build.dispose();
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main();
