import assert from "node:assert/strict";
import { test } from "node:test";
import { Quaternion, Vector3 } from "three";
import { onCap } from "../../app/frontend/src/lab/caps.js";
import { Frames } from "../../app/frontend/src/motion/frames.js";
import { passedBy, traceOf } from "../../app/frontend/src/motion/trace.js";
import { motion, near } from "./helping.js";

// A ball that rolls along y about its axis 3, which lies along x: as far round its equator as along the table.
const FROM = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), Math.PI / 2);
const rolls = (angle, up = 0) => {
  const { x, y, z, w } = new Quaternion().setFromAxisAngle(new Vector3(-1, 0, 0), angle).multiply(FROM);
  return { t: angle, quaternion: [x, y, z, w], contact: [0, angle], com: [0, angle, 1 + up], theta: Math.PI / 2 };
};
const frames = (...rows) => new Frames(motion(rows));

test("a ball that rolls round its equator is marked there, as far as it has gone", () => {
  for (const a of [null, 0]) {
    const { places, marks, on } = traceOf(frames(...[0, 0.5, 1, 1.5].map((angle) => rolls(angle))), a);
    assert.ok(on.every(Boolean) && places.length > 8 && places.at(-1) === 3);
    const around = marks.map(({ x, y }) => Math.atan2(y, x)), went = around.map((each) => Math.abs(Math.atan2(Math.sin(each - around[0]), Math.cos(each - around[0]))));
    went.forEach((each, i) => near(each, 0.5 * places[i], 1e-5));
    marks.forEach((mark) => near([mark.z, mark.length()], [0, 1], 1e-5));
  }
});

test("there is no mark while it flies or stands on its stem", () => {
  const { places, on } = traceOf(frames(rolls(0), rolls(0.1), rolls(0.2, 0.1), rolls(0.3)), 0);
  assert.deepEqual([0, 1, 2, 3].map((place) => on[places.indexOf(place)]), [true, true, false, true]);
});

test("what has passed is found by place", () => {
  const trace = { places: [0, 0.5, 1, 2], marks: [], on: [] };
  assert.deepEqual([-1, 0, 0.7, 2, 9].map((place) => passedBy(trace, place)), [0, 1, 2, 4, 4]);
});

test("on the map the bottom and the stem are in the middle, and both caps are seen from outside", () => {
  near(onCap({ x: 0, y: 0, z: -1 }), [0, 0, 0]);
  near(onCap({ x: 0, y: 0, z: 1 }), [1, 0, 0]);
  near(onCap({ x: 1, y: 0, z: -1e-9 }), [0, -1, 0]);
  near(onCap({ x: 1, y: 0, z: 1e-9 }), [1, 1, 0]);
  near(onCap({ x: 0, y: Math.SQRT1_2, z: -Math.SQRT1_2 }), [0, 0, 0.5]);
});
