import assert from "node:assert/strict";
import { test } from "node:test";
import { SunTool } from "../src/ui/sun_tool.js";

/** What a key of the sun's handle sets, while the photo's own sun is where it is. */
function pressed(key) {
  const set = [];
  const tool = Object.create(SunTool.prototype);
  tool.track = null;
  tool.picture = { value: (name) => ({ sun_azimuth: 9.41234567, sun_elevation: 20 })[name] };
  tool.state = {
    parameters: [
      { name: "sun_azimuth", minimum: -180, maximum: 180 },
      { name: "sun_elevation", minimum: -12, maximum: 90 },
    ],
    begin() {},
    set: (changes) => set.push(changes),
  };
  tool.onKey({ key, preventDefault() {}, stopPropagation() {} });
  return set;
}

test("an arrow key changes what it moves, and no more", () => {
  assert.deepEqual(pressed("ArrowUp"), [{ sun_elevation: 20.5 }]);
  assert.deepEqual(pressed("ArrowLeft"), [{ sun_azimuth: 8.9123 }]);
});
