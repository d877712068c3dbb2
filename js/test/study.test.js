import assert from "node:assert/strict";
import { test } from "node:test";
import { csv } from "../src/study/csv.js";
import { trials } from "../src/study/trials.js";

const METHODS = ["a", "b", "c", "d"].map((name, picture) => ({ name, picture }));
const GROUPS = ["coast", "meadow"].map((name) => ({ name, methods: METHODS }));
const pair = ({ group, left, right }) => [group, ...[left.name, right.name].sort()].join(" ");
const order = (options) => trials(GROUPS, { seed: 0, rater: "anna", repeats: 3, ...options });

test("every pair of every photo comes as often as asked for, once a round", () => {
  const found = order({});
  assert.equal(found.length, 3 * 2 * 6);
  for (let round = 0; round < 3; round++) {
    const pairs = found.slice(12 * round, 12 * (round + 1)).map(pair);
    assert.equal(new Set(pairs).size, 12);
  }
});

test("a pair's sides swap from round to round", () => {
  const found = order({ repeats: 2 });
  const sides = new Map(found.slice(0, 12).map((trial) => [pair(trial), trial.left.name]));
  for (const trial of found.slice(12)) assert.equal(trial.right.name, sides.get(pair(trial)));
});

test("the order is the rater's own, the study's own, and stays", () => {
  assert.deepEqual(order({}), order({}));
  assert.notDeepEqual(order({}), order({ rater: "bert" }));
  assert.notDeepEqual(order({}), order({ seed: 1 }));
});

test("no method is kept to one side, no pair to one place", () => {
  let left = 0;
  const firsts = new Set();
  for (let rater = 0; rater < 400; rater++) {
    const found = order({ rater: `r${rater}`, repeats: 1 });
    left += found.filter((trial) => trial.left.name === "a").length;
    firsts.add(pair(found[0]));
  }
  // 400 raters see "a" six times each: 1200 ± 24 of them on the left.
  assert.ok(Math.abs(left - 1200) < 100, `${left}`);
  assert.equal(firsts.size, 12);
});

test("a field that would break its row is quoted", () => {
  const answer = {
    rater: 'say "hi", twice',
    trial: 1,
    picture: "line\nbreak",
    left: "a",
    right: "b",
    choice: "left",
    seconds: 1.25,
    timestamp: "2026-11-21T10:00:00.000Z",
  };
  assert.equal(
    csv([answer]),
    "rater,trial,picture,left,right,choice,seconds,timestamp\r\n" +
      '"say ""hi"", twice",1,"line\nbreak",a,b,left,1.25,2026-11-21T10:00:00.000Z\r\n',
  );
});
