import assert from "node:assert/strict";
import { test } from "node:test";
import { between, clear } from "../../app/frontend/src/controls/number.js";

const texts = { beyond: "beyond {mark}", between: "{percent} percent of the way from {from} to {to}" };

test("a slider with marks names the marks around its value", () => {
  const marks = [[0, "steady"], [2, "slips"], [3, "lifts off"]], wording = {
    0: "steady", 0.5: "25 percent of the way from steady to slips", 2: "slips", 2.9: "90 percent of the way from slips to lifts off",
    3: "lifts off", 3.1: "beyond lifts off",
  };
  for (const [value, words] of Object.entries(wording)) assert.equal(between(Number(value), marks, texts), words);
});

test("words at marks that are too close leave room for the first", () => {
  assert.deepEqual(clear([[0, "steady"], [0.45, "slips"], [0.86, "lifts off"]]), [true, true, true]);
  assert.deepEqual(clear([[0, "steady"], [0.11, "slips"], [0.5, "lifts off"]]), [true, false, true]); // E far above them
});
