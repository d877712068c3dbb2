/**
 * Build the front end into `sunwidget/static/`. `--watch` rebuilds on change.
 *
 * The shaders and the frame graph are bundled as text, so the page that draws and the kernel
 * that exports hold the same passes.
 */

import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { context } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const shaders = join(here, "..", "sunwidget", "shaders");
const out = join(here, "..", "sunwidget", "static");

/** Drop comments and indentation but no line, so that a compiler's line numbers stay true. */
export function stripComments(/** @type {string} */ text) {
  return text
    .replace(/\/\*[\s\S]*?\*\//g, (comment) => comment.replace(/[^\n]/g, ""))
    .replace(/\/\/[^\n]*/g, "")
    .replace(/^[ \t]+|[ \t]+$/gm, "");
}

/**
 * Drop the blanks round GLSL's signs. Not round + and -, where `a - -b` would become another
 * word, and not in a directive, where they tell a macro from its arguments.
 */
export function tighten(/** @type {string} */ text) {
  return text.replace(/^[^#\n].*$/gm, (line) => line.replace(/ *([=*/<>,;{}()?:&|!]) */g, "$1"));
}

/** Text of every shader by its path relative to `shaders/`. */
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

/** @type {import("esbuild").Plugin} */
const shaderPlugin = {
  name: "sunwidget-shaders",
  setup(build) {
    build.onResolve({ filter: /^sunwidget:shaders$/ }, ({ path }) => ({ path, namespace: "glsl" }));
    build.onLoad({ filter: /.*/, namespace: "glsl" }, () => {
      const stripped = Object.entries(readShaders()).map(([name, text]) => [
        name,
        tighten(stripComments(text)),
      ]);
      const graph = readFileSync(join(shaders, "graph.json"), "utf-8");
      return {
        contents:
          `export const files = ${JSON.stringify(Object.fromEntries(stripped))};\n` +
          `export const graph = ${JSON.stringify(JSON.parse(graph))};\n`,
        loader: "js",
        watchDirs: [shaders, join(shaders, "lib")],
      };
    });
  },
};

async function main() {
  const build = await context({
    entryPoints: [
      { in: join(here, "src", "editor", "index.js"), out: "sun_editor" },
      { in: join(here, "src", "editor", "style.css"), out: "sun_editor" },
    ],
    outdir: out,
    bundle: true,
    minify: true,
    format: "esm",
    target: "es2022",
    logLevel: "info",
    legalComments: "none",
    plugins: [shaderPlugin],
  });
  if (process.argv.includes("--watch")) {
    await build.watch();
    return;
  }
  await build.rebuild();
  await build.dispose();
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main();
