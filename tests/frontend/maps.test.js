import assert from "node:assert/strict";
import test from "node:test";
import { keyed } from "../../app/frontend/src/figures/maps.js";

const RANGES = { x_range: { start: 0, end: 48 }, y_range: { start: 10, end: 34 } }, CELLS = /** @type {[number, number]} */ ([48, 24]);

test("an arrow key moves the bead by a cell, with Shift by a tenth of one", () => {
  assert.deepEqual(keyed("ArrowRight", false, [5.5, 20.5], RANGES, CELLS), [6.5, 20.5]);
  assert.deepEqual(keyed("ArrowDown", false, [5.5, 20.5], RANGES, CELLS), [5.5, 19.5]);
  assert.deepEqual(keyed("ArrowUp", true, [5, 20], RANGES, CELLS), [5, 20.1]);
});

test("the bead stays on the map", () => {
  assert.deepEqual(keyed("ArrowLeft", false, [0.5, 20], RANGES, CELLS), [0, 20]);
  assert.deepEqual(keyed("ArrowUp", false, [5, 34], RANGES, CELLS), [5, 34]);
});
