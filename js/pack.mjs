/**
 * Pack a bundle: anywidget saves it in the notebook once a widget, so its bytes count, and text
 * deflates to a third. What is left is a module that inflates itself and hands on what it exports,
 * by way of a blob's address as anywidget itself does with every module it gets as text.
 *
 * anywidget loads a module for every widget, and a browser never drops one: a page inflates each
 * text once, and every further widget takes the module that is there.
 */

import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { deflateRawSync } from "node:zlib";

/**
 * @param {string} code an ES module without imports, with a default export
 * @param {string[]} [names] other exports to hand on
 * @param {string} [notice] licence of what the bundle contains, to stand above it
 * @returns {string} the same, packed
 */
export function pack(code, names = [], notice = "") {
  const packed = deflateRawSync(Buffer.from(code, "utf-8"), { level: 9 }).toString("base64");
  const key = createHash("sha256").update(packed).digest("hex").slice(0, 16);
  return [
    ...(notice ? [`/*!\n${notice.trim()}\n*/`] : []),
    "const unpack=async()=>{",
    `const packed="${packed}";`,
    "const bytes=Uint8Array.from(atob(packed),(c)=>c.charCodeAt(0));",
    'const plain=new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));',
    "const text=await new Response(plain).text();",
    'const url=URL.createObjectURL(new Blob([text],{type:"text/javascript"}));',
    "try{return await import(url);}finally{URL.revokeObjectURL(url);}",
    "};",
    `const key=Symbol.for("sunwidget:${key}");`,
    "const module=await(globalThis[key]??=unpack());",
    "export default module.default;",
    ...names.map((name) => `export const ${name}=module.${name};`),
    "",
  ].join("\n");
}

/**
 * Pack a file of the build where it lies.
 *
 * @param {string} path
 * @param {string[]} names exports beside the default
 * @param {string} notice as `pack` takes it
 * @returns {import("esbuild").Plugin}
 */
export const packPlugin = (path, names, notice) => ({
  name: "sunwidget-pack",
  setup(build) {
    build.onEnd(({ errors }) => {
      if (!errors.length) writeFileSync(path, pack(readFileSync(path, "utf-8"), names, notice));
    });
  },
});
