import assert from "node:assert/strict";
import { test } from "node:test";
import { inflateRawSync } from "node:zlib";
import { bytesOf, pack, textOf } from "../pack.mjs";

/** The text that a packed module inflates, by what the module itself says. */
function inflated(packed) {
  const [, payload] = /^const packed="([^"]+)";/m.exec(packed);
  const [, digits, length] = /bytesOf\(packed,"([^"]+)"\)\.subarray\(0,(\d+)\)/.exec(packed);
  return inflateRawSync(bytesOf(payload, digits).subarray(0, Number(length))).toString("utf-8");
}

test("a packed module holds its text to the letter, and is smaller", () => {
  const code = `export default { text: "sin θ ≈ θ" };\n${"const x = 1;\n".repeat(500)}`;
  const packed = pack(code);
  assert.equal(inflated(packed), code);
  assert.ok(packed.length < code.length / 2);
});

test("bytes of every length come back, in signs that JSON and HTML leave as they are", () => {
  const [, digits] = /bytesOf\(packed,"([^"]+)"/.exec(pack("export default 1;"));
  assert.equal(new Set(digits).size, 91);
  assert.match(digits, /^[ -~]+$/);
  assert.doesNotMatch(digits, /["\\<&]/);
  for (let length = 0; length < 60; length++) {
    const bytes = Uint8Array.from({ length }, (_, i) => (i * 197 + length * 31) & 255);
    const text = textOf(bytes);
    assert.ok(text.length <= Math.ceil((length * 8) / 13) * 2);
    assert.deepEqual(bytesOf(text, digits).subarray(0, length), bytes);
  }
});

test("a licence stands above the module, whose other exports are handed on", () => {
  const packed = pack("export default 1; export const Two = 2;", ["Two"], "(c) somebody\n");
  assert.match(packed, /^\/\*!\n\(c\) somebody\n\*\/\n/);
  assert.match(packed, /export const Two=module\.Two;/);
});
