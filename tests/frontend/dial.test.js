import assert from "node:assert/strict";
import { test } from "node:test";
import { spoken } from "../../app/frontend/src/widgets/dial.js";

const texts = { beyond: "beyond {mark}", between: "{percent} percent of the way from {from} to {to}" };

test("a slider with marks names the marks around its value", () => {
  const marks = [[0, "steady"], [2, "slips"], [3, "lifts off"]], said = {
    0: "steady", 0.5: "25 percent of the way from steady to slips", 2: "slips", 2.9: "90 percent of the way from slips to lifts off",
    3: "lifts off", 3.1: "beyond lifts off",
  };
  for (const [value, words] of Object.entries(said)) assert.equal(spoken(Number(value), { marks, unit: "", texts }), words);
});

test("a slider without marks has its value and unit as text", () => {
  assert.equal(spoken(-6.97 - 1e-12, { marks: [], unit: "metres", texts }), "−6.97 metres");
});
