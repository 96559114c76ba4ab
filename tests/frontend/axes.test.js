import assert from "node:assert/strict";
import { test } from "node:test";
import { Scale } from "../../app/frontend/src/three/axes.js";
import { near } from "./helping.js";

test("ticks are all the round numbers of the range", () => {
  const known = [
    [0, 1, [0, 0.2, 0.4, 0.6, 0.8, 1]],
    [-1, 1, [-1, -0.5, 0, 0.5, 1]],
    [0.03, 0.21, [0.05, 0.1, 0.15, 0.2]],
    [0, 120, [0, 25, 50, 75, 100]],
    [6, 48, [10, 20, 30, 40]],
  ];
  const scale = new Scale(-1, 1);
  for (const [low, high, ticks] of known) {
    scale.set(low, high);
    near(scale.ticks, ticks, 1e-12 * high);
  }
});

test("the ends of the range are at the ends of the edge, and values between are in proportion", () => {
  const scale = new Scale(-2, 6);
  assert.equal(scale.set(10, 30), true);
  near([10, 15, 30, 40].map(scale.at), [-2, 0, 6, 10]);
  near([-2, 0, 6, 10].map(scale.value), [10, 15, 30, 40]);
  assert.equal(scale.set(10, 30), false); // nothing has changed
  scale.set(5, 5); // a single value is in the middle
  near(scale.at(5), 2);
});

test("a scale from 0 ends at a tick just above the greatest value", () => {
  const scale = new Scale(0, 1);
  for (const [most, high] of [[0.97, 1], [1, 1], [1.01, 1.25], [130, 150], [0, 1]]) {
    scale.setAbove(most);
    near([scale.low, scale.high, scale.ticks.at(-1)], [0, high, high], 1e-9);
  }
});

test("a tick has as many digits as distinguish it from the next", () => {
  const written = (low, high) => {
    const scale = new Scale(0, 1);
    scale.set(low, high);
    return scale.ticks.map((tick) => scale.text(tick));
  };
  assert.deepEqual(written(0, 1), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
  assert.deepEqual(written(-10, 10), ["−10", "−5", "0", "5", "10"]);
  assert.deepEqual(written(0, 0.1), ["0.00", "0.02", "0.04", "0.06", "0.08", "0.10"]);
  assert.deepEqual(written(0, 1.25), ["0.00", "0.25", "0.50", "0.75", "1.00", "1.25"]);
  assert.deepEqual(written(-0.3, 0.3), ["−0.2", "0.0", "0.2"]);
});
