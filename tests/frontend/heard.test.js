import assert from "node:assert/strict";
import { test } from "node:test";
import { Frames } from "../../app/frontend/src/motion/frames.js";
import { heardOf } from "../../app/frontend/src/motion/heard.js";
import { motion, near } from "./helping.js";

const heard = (rows) => heardOf(new Frames(motion(rows)));
const times = Array.from({ length: 21 }, (_, i) => i / 20);

test("what rubs is the point that touches: a ball that rolls is silent, one that spins on the spot or slides is not", () => {
  // G moves along x at 2, the ball turns about y; its lowest point is 1 below G
  const moves = (omega) => times.map((t) => ({ t, com: [2 * t, 0, 1], contact: [2 * t, 0], omega: [0, omega, 0], force: [-0.3, 0.4, 1] }));
  near(heard(moves(2)).slip, times.map(() => 0), 1e-5);
  near(heard(moves(0)).slip, times.map(() => 2), 1e-5);
  near(heard(moves(-1)).rub, times.map(() => 3 * 0.5), 1e-5);
  near(heard(moves(-1)).turn, times.map(() => 1));
});

test("in the air nothing rubs, and what falls and stays is heard once, with its impulse", () => {
  const rows = times.map((t) => ({ t, com: [0, 0, 1 + Math.max(0.125 - t ** 2 / 2, 0)], omega: [0, 0, 5], contact: [0.1, 0], force: [0, 0, Number(t > 0.5)] }));
  const { rub, slip, touches } = heard(rows);
  assert.ok(rub.every((each) => each === 0) && slip[2] === 0);
  near(slip[20], 0.5); // it spins about an axis 0.1 beside the point that touches
  const total = touches.reduce((sum, [, impulse]) => sum + impulse, 0);
  near(total, 0.5, 0.06); // it fell for 0.5
  assert.ok(touches.every(([place]) => Math.abs(place - 10) <= 1));
});

test("a steady load is no impulse, nor is a motion of one frame or none", () => {
  assert.deepEqual(heard(times.map((t) => ({ t, com: [0, 0, 1 + 0.1 * Math.cos(2 * t)], force: [0, 0, 1 - 0.4 * Math.cos(2 * t)] }))).touches, []);
  assert.deepEqual([heard([]).slip.length, heard([{ t: 0 }]).touches.length], [0, 0]);
});
