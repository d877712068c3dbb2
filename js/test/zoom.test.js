import assert from "node:assert/strict";
import { test } from "node:test";
import { Zoom } from "../src/geometry/zoom.js";

/** A stage of 900 × 600 with a margin of 20, in which a picture of 3:2 fits. */
function zoomOf({ size = [2000, 1333], pixelRatio = 1 } = {}) {
  const zoom = new Zoom();
  zoom.size = size;
  zoom.setRoom({
    width: 900,
    height: 620,
    fit: { x: 20, y: 20, width: 860, height: 580 },
    pixelRatio,
  });
  return zoom;
}

/** @type {(a: number[], b: number[], within: number) => void} */
const near = (a, b, within) => {
  a.forEach((value, i) => {
    assert.ok(Math.abs(value - b[i]) <= within, `${a} is not within ${within} of ${b}`);
  });
};

test("the picture fits until it is zoomed, and then again", () => {
  const zoom = zoomOf();
  assert.deepEqual(zoom.box(), { x: 20, y: 20, width: 860, height: 580 });
  zoom.zoomTo(1);
  assert.equal(zoom.fits, false);
  zoom.zoomTo(0.01);
  assert.equal(zoom.fits, true);
});

test("at 100 % a pixel of the preview is a pixel of the screen, whatever the screen", () => {
  for (const pixelRatio of [1, 1.5, 2]) {
    const zoom = zoomOf({ pixelRatio });
    zoom.zoomTo(1);
    const { width, height } = zoom.box();
    near([width * pixelRatio, height * pixelRatio], [2000, 1333], 1e-9);
  }
});

test("what is under the pointer stays there", () => {
  const zoom = zoomOf();
  /** @type {[number, number]} */
  const at = [610, 240];
  const place = zoom.placeAt(at);
  for (const scale of [0.7, 1, 3, 8, 2.2]) {
    zoom.zoomTo(scale, at);
    near(zoom.placeAt(at), place, 1e-3);
  }
});

test("the picture is never shifted past its edge, and the way back begins at once", () => {
  const zoom = zoomOf();
  zoom.zoomTo(2);
  zoom.pan(1e5, 1e5);
  near([zoom.box().x, zoom.box().y], [20, 20], 1e-9);
  zoom.pan(-10, -10);
  near([zoom.box().x, zoom.box().y], [10, 10], 1e-6);
  zoom.pan(-1e5, -1e5);
  const { x, y, width, height } = zoom.box();
  near([x + width, y + height], [880, 600], 1e-9);
});

test("steps go up and down again, and the fit is one of them", () => {
  const zoom = zoomOf();
  const up = [];
  for (let i = 0; i < 4; i++) {
    zoom.step(1);
    up.push(zoom.scale);
  }
  assert.deepEqual(up, [0.5, 0.667, 1, 1.5]);
  for (let i = 0; i < 4; i++) zoom.step(-1);
  assert.equal(zoom.fits, true);
  zoom.step(-1);
  assert.equal(zoom.fits, true);
});

test("a small preview is larger than 100 % when it fits, and can be shown at 100 %", () => {
  const zoom = zoomOf({ size: [430, 290] });
  assert.equal(zoom.scale, 2);
  zoom.toggle();
  assert.equal(zoom.scale, 1);
  near([zoom.box().x, zoom.box().y], [235, 165], 1);
  zoom.toggle();
  assert.equal(zoom.fits, true);
});

test("a stage that grows past a zoomed picture shows all of it", () => {
  const zoom = zoomOf();
  zoom.zoomTo(0.5);
  const fit = { x: 20, y: 20, width: 1800, height: 1200 };
  zoom.setRoom({ width: 1840, height: 1240, fit, pixelRatio: 1 });
  assert.equal(zoom.fits, true);
});

test("every change by hand is told once, and a new room is not", () => {
  const zoom = zoomOf();
  let told = 0;
  zoom.onChange = () => {
    told += 1;
  };
  zoom.pan(10, 10);
  assert.equal(told, 0); // it fits: there is nothing to shift
  zoom.step(1);
  zoom.pan(-10, 0);
  zoom.hold([0.5, 0.5], [450, 310], 2);
  zoom.toggle();
  assert.equal(told, 4);
  zoom.zoomTo(0.5);
  const fit = { x: 20, y: 20, width: 1800, height: 1200 };
  zoom.setRoom({ width: 1840, height: 1240, fit, pixelRatio: 1 });
  assert.equal(told, 5);
});
