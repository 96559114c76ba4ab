import assert from "node:assert/strict";
import { test } from "node:test";
import { nearestRow, spotInTurn, spotOf, timeAtPoint, timeAtTilt, valueAt } from "../../app/frontend/src/figures/curves.js";
import { rowBefore } from "../../app/frontend/src/data.js";
import { beadAt } from "../../app/frontend/src/figures/run.js";
import { turned } from "../../app/frontend/src/learn/arms.js";
import { near } from "./helping.js";

const same = { compute: (value) => value, invert: (px) => px };

test("values are interpolated linearly between rows, and constant beyond the ends", () => {
  const t = [10, 12, 14, 16], values = [0, 1, 4, 9];
  for (const [now, wanted] of [[10, 0], [11, 0.5], [13.5, 3.25], [16, 9], [99, 9], [-5, 0]]) near(valueAt(values, spotOf(t, now)), wanted);
});

test("one nutation repeats", () => {
  const t = [0, 1, 2], values = [5, 6, 7];
  for (const [now, wanted] of [[-3, 5], [0.5, 5.5], [2, 7], [2.5, 5.5], [101.25, 6.25]]) near(valueAt(values, spotInTurn(t, now)), wanted);
});

test("a row is found among unevenly spaced times, in columns and in tables", () => {
  const t = [0, 1, 4, 4.5, 30];
  for (const now of [-1, 0, 0.5, 1, 3.9, 4, 4.49, 29, 30, 31]) {
    const wanted = Math.max(0, t.slice(0, -1).findLastIndex((time) => time <= now));
    assert.equal(rowBefore(t, now), wanted);
    assert.equal(rowBefore(t.flatMap((time) => [time, 7, 7]), now, 3), wanted);
  }
});

test("the nearest row is found, and the first of two", () => {
  assert.deepEqual([nearestRow([1, 2, 3], 2.4), nearestRow([1, 2, 3], 1.5), nearestRow([1, 2, 3], 99)], [1, 0, 2]);
});

test("of the many times at which a motion has a tilt, the one closest to now is found", () => {
  const t = Float64Array.from({ length: 401 }, (_, i) => i / 20), theta = t.map(Math.sin); // three turns
  const half = Math.PI / 6; // sin is 1/2 there, and at pi minus that
  for (const [now, wanted] of [[0, half], [2, Math.PI - half], [7, 2 * Math.PI + half], [15, 5 * Math.PI - half]]) {
    near(timeAtTilt({ t, theta }, 0.5, now), wanted, 1e-3);
  }
  near(timeAtTilt({ t, theta }, 1, 1), Math.PI / 2, 0.05);
});

test("beyond all tilts, the nearest one is found", () => near(timeAtTilt({ t: [0, 1, 2], theta: [1, 2, 1] }, 5, 0), 1));

test("a motion of constant tilt stays at its time", () => {
  near(timeAtTilt({ t: [0, 1, 2], theta: [1, 1, 1] }, 1, 0), 0);
});

test("near a curve its time is found, and on one nutation in the present repetition", () => {
  const t = Float64Array.from({ length: 101 }, (_, i) => i / 100);
  const curve = { t, x: t.map((s) => 100 * Math.cos(2 * Math.PI * s)), y: t.map((s) => 100 * Math.sin(2 * Math.PI * s)) };
  near(timeAtPoint(curve, [0, 130], 0.1, true, { x: same, y: same }), 0.25);
  near(timeAtPoint(curve, [0, 130], 7.2, false, { x: same, y: same }), 7.25);
  near(timeAtPoint(curve, [0, 130], 7.2, true, { x: same, y: same }), 0.25);
});

test("the bead is in the well of its time, and in none between two", () => {
  const path = { t: [0, 1, 2, 3], theta: [0, 10, 20, 30], V: [1, 1, 2, 2], E: [3, 2, 2, 1], well: [0, 0, 1, 1] };
  assert.deepEqual(beadAt(path, 0.5), { which: 0, theta: 5, V: 1, E: 2.5 });
  assert.equal(beadAt(path, 1.5).which, -1);
  assert.deepEqual(beadAt(path, 9), { which: 1, theta: 30, V: 2, E: 1 });
});

test("the section of a sphere stands on the contact however it leans, and its axis points where it leans", () => {
  const circle = Array.from({ length: 101 }, (_, i) => (2 * Math.PI * i) / 100);
  for (const theta of [0, 0.7, Math.PI / 2, 3]) {
    const points = circle.map((angle) => turned([Math.sin(angle), Math.cos(angle)], [-Math.sin(theta), Math.cos(theta)]));
    near(Math.min(...points.map(([, y]) => y)), 0, 1e-3);
    for (const [x, y] of points) near(Math.hypot(x, y - 1), 1);
  }
  near(turned([0, 1.9], [-1, 0]), [-1.9, 1]);
});
