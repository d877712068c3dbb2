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
 * Signs that stand for themselves in a string of JavaScript, in the JSON of a notebook and in
 * HTML: two of 91 hold 13 bits, where base64 holds 12 in two.
 */
const DIGITS = Array.from({ length: 95 }, (_, i) => String.fromCharCode(32 + i))
  .filter((sign) => !'"\\<&'.includes(sign))
  .join("");

/**
 * Write bytes in signs of `DIGITS`; the last bits are filled up with zeros.
 *
 * @param {Uint8Array} bytes
 */
export function textOf(bytes) {
  let [bits, held, text] = [0, 0, ""];
  const put = () => {
    const number = bits & 8191;
    text += DIGITS[Math.floor(number / 91)] + DIGITS[number % 91];
    bits >>= 13;
    held -= 13;
  };
  for (const byte of bytes) {
    bits |= byte << held;
    held += 8;
    if (held >= 13) put();
  }
  if (held > 0) put();
  return text;
}

/**
 * The inverse. It travels in every packed module as its own text, so it names nothing else.
 *
 * @param {string} text
 * @param {string} digits
 */
export function bytesOf(text, digits) {
  const bytes = new Uint8Array((text.length * 13) >> 4);
  let [bits, held, n] = [0, 0, 0];
  for (let i = 0; i < text.length; i += 2) {
    bits |= (digits.indexOf(text[i]) * 91 + digits.indexOf(text[i + 1])) << held;
    for (held += 13; held > 7; held -= 8) {
      bytes[n++] = bits;
      bits >>= 8;
    }
  }
  return bytes;
}

/**
 * @param {string} code an ES module without imports, with a default export
 * @param {string[]} [names] other exports to hand on
 * @param {string} [notice] licence of what the bundle contains, to stand above it
 * @returns {string} the same, packed
 */
export function pack(code, names = [], notice = "") {
  const plain = deflateRawSync(Buffer.from(code, "utf-8"), { level: 9 });
  const packed = textOf(plain);
  const key = createHash("sha256").update(packed).digest("hex").slice(0, 16);
  return [
    ...(notice ? [`/*!\n${notice.trim()}\n*/`] : []),
    bytesOf.toString(),
    "const unpack=async()=>{",
    `const packed="${packed}";`,
    // An inflater takes nothing after the end: the last digits may hold a byte too much.
    `const bytes=bytesOf(packed,"${DIGITS}").subarray(0,${plain.length});`,
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
