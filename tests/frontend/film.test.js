// Which moments of a run a film shows.
import assert from "node:assert/strict";
import { test } from "node:test";
import { timesOf } from "../../app/frontend/src/motion/filmed.js";

test("a film shows its stretch from end to end, slowly where the pace is slow, and no longer than allowed", () => {
  assert.deepEqual(timesOf([0, 1], () => 1, 4, 99), [0, 0.25, 0.5, 0.75, 1]);
  assert.deepEqual(timesOf([0, 1], (t) => (t < 0.5 ? 0.5 : 2), 4, 99), [0, 0.125, 0.25, 0.375, 0.5, 1]);
  assert.deepEqual(timesOf([2, 9], () => 1, 1, 3), [2, 3, 4]);
  assert.equal(timesOf([0, 1], () => 1, 30, 99).length, 31); // not one more for how numbers are rounded
});
