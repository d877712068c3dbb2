import assert from "node:assert/strict";
import { test } from "node:test";
import { notesOf } from "../src/editor/view/note_choice.js";
import {
  assumedText,
  bearingText,
  confidenceText,
  heightText,
  LIKELY,
  markText,
  pointedText,
  positionText,
} from "../src/ui/sun_words.js";

const sun = (changes) => ({
  ...{ source: "unseen", at: null, visible: false, azimuth: -140, elevation: 35 },
  ...{ confidence: 0.4, moon: null },
  ...changes,
});
const now = (changes) => ({
  ...{ live: true, inside: false, picking: false, pending: false, hint: null },
  ...changes,
});

test("a bearing is said as whoever holds the camera sees it", () => {
  const said = {
    0: "ahead",
    22: "ahead",
    23: "ahead to the right",
    90: "to the right",
    135: "behind the camera to the right",
    180: "behind the camera",
    "-180": "behind the camera",
    "-140": "behind the camera to the left",
    "-90": "to the left",
    "-45": "ahead to the left",
    "-10": "ahead",
    350: "ahead",
  };
  for (const [azimuth, words] of Object.entries(said)) {
    assert.equal(bearingText(Number(azimuth)), words, azimuth);
  }
});

test("a height is above or below the horizon, and overhead there is no bearing", () => {
  assert.equal(heightText(34.6), "35° high");
  assert.equal(heightText(-2), "2° below the horizon");
  assert.equal(heightText(-0.3), "on the horizon");
  assert.equal(positionText({ azimuth: 100, elevation: 12 }), "to the right, 12° high");
  assert.equal(positionText({ azimuth: 100, elevation: 84 }), "almost overhead");
});

test("a percentage is shown where one was measured, and never a hundred", () => {
  assert.equal(confidenceText(0.934), "93\u00a0% sure");
  assert.equal(confidenceText(0.999), "more than 99\u00a0% sure");
  assert.equal(confidenceText(1), "");
  assert.equal(markText(sun({ source: "found", confidence: 1 })), "The photo’s sun");
  assert.equal(
    markText(sun({ source: "found", confidence: 0.93 })),
    "The photo’s sun, 93\u00a0% sure",
  );
  assert.equal(markText(sun({ source: "told", confidence: 1 })), "The photo’s sun, set by you");
});

test("of an unseen sun is said where, whether to believe it, and why that matters", () => {
  assert.equal(
    assumedText(sun(), now()),
    "No sun is in view. It is assumed to be behind the camera to the left, 35° high, but that is " +
      "a guess. Shadows and sky follow from there, so mark the sun if you know where it is.",
  );
  const likely = assumedText(sun({ confidence: LIKELY }), now());
  assert.match(likely, /It is probably behind the camera to the left, at a guess 35° high\./);
  assert.match(assumedText(sun(), now({ inside: true })), /^No sun was found\./);
  assert.match(
    assumedText(sun({ source: "outside" }), now()),
    /^You said that the sun is not in the picture\. It is assumed/,
  );
  assert.match(assumedText(sun(), now({ live: false })), /follow from there\.$/);
  for (const confidence of [0, 0.94, 1]) {
    assert.doesNotMatch(assumedText(sun({ confidence }), now()), /%/);
  }
});

test("a place that was pointed at is said back", () => {
  const told = sun({ source: "told", azimuth: 12, elevation: 8.2, visible: true });
  assert.equal(pointedText(told), "The photo’s sun is set: ahead, 8° high.");
  assert.match(pointedText({ ...told, visible: false }), /out of sight\.$/);
});

const unseen = { about: "unseen_sun", text: "pass sun=(x, y)" };
const horizon = { about: "horizon", text: "The horizon is a guess." };
const lens = { about: "field_of_view", text: "No lens." };
const actions = (rows) => rows.map((row) => row.actions);

test("a note offers what can be done about it", () => {
  const rows = notesOf({ notes: [unseen, horizon, lens], sun: sun() }, now());
  assert.deepEqual(actions(rows), [["pick"], ["horizon"], []]);
  assert.match(rows[0].text, /^No sun is in view/);
  assert.equal(rows[1].text, horizon.text);
});

test("without a kernel nothing is offered that needs one", () => {
  const rows = notesOf({ notes: [unseen, horizon], sun: sun() }, now({ live: false }));
  assert.deepEqual(actions(rows), [[], []]);
});

test("while the sun is said anew, notes about it wait", () => {
  const scene = { notes: [unseen, horizon], sun: sun() };
  const pending = notesOf(scene, now({ pending: true }));
  assert.deepEqual(actions(pending), [["horizon"]]);
  const picking = notesOf(scene, now({ picking: true }));
  assert.deepEqual(actions(picking), [["leave"], ["horizon"]]);
  assert.match(picking[0].text, /^Click where the photo’s sun is/);
  assert.equal(picking[0].stays, true);
});

test("only what this edit said can be taken back", () => {
  const told = { notes: [{ about: "told_outside", text: "" }], sun: sun({ source: "outside" }) };
  assert.deepEqual(actions(notesOf(told, now({ hint: "outside" }))), [["take_back", "pick"]]);
  assert.deepEqual(actions(notesOf(told, now())), [["pick"]]);
});

test("a found sun is doubted aloud below three in four", () => {
  const found = (confidence) => ({ notes: [lens], sun: sun({ source: "found", confidence }) });
  assert.deepEqual(actions(notesOf(found(0.76), now())), [[]]);
  const rows = notesOf(found(0.62), now());
  assert.deepEqual(actions(rows), [["not_sun", "pick"], []]);
  assert.match(rows[0].text, /something else \(62\u00a0% sure\)/);
});

test("a moon can be said to be the sun", () => {
  const night = { notes: [{ about: "moon", text: "A moon." }], sun: sun({ moon: [0.5, 0.2] }) };
  assert.deepEqual(actions(notesOf(night, now())), [["moon_is_sun"]]);
});
