import assert from "node:assert/strict";
import { test } from "node:test";
import { inflateRawSync } from "node:zlib";
import { pack } from "../pack.mjs";

test("a packed module holds its text to the letter, and is smaller", () => {
  const code = `export default { text: "sin θ ≈ θ" };\n${"const x = 1;\n".repeat(500)}`;
  const packed = pack(code);
  const [, payload] = /^const packed="([^"]+)";/m.exec(packed);
  assert.equal(inflateRawSync(Buffer.from(payload, "base64")).toString("utf-8"), code);
  assert.ok(packed.length < code.length / 2);
});

test("a licence stands above the module, whose other exports are handed on", () => {
  const packed = pack("export default 1; export const Two = 2;", ["Two"], "(c) somebody\n");
  assert.match(packed, /^\/\*!\n\(c\) somebody\n\*\/\nconst unpack=/);
  assert.match(packed, /export const Two=module\.Two;/);
});
