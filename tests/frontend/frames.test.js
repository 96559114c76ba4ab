import assert from "node:assert/strict";
import { test } from "node:test";
import { Quaternion, Vector3 } from "three";
import { centreOf, Frames, emptyPose } from "../../app/frontend/src/motion/frames.js";
import { nearest } from "../../app/frontend/src/three/handle.js";
import { motion, near } from "./helping.js";

const times = [1, 2, 4, 4.5, 8];
const frames = new Frames(motion(times.map((t) => ({ t }))));

test("the position of a time is its row, plus the fraction of the way to the next", () => {
  assert.deepEqual([frames.start, frames.end, frames.count], [1, 8, 5]);
  for (const [t, place] of [[1, 0], [1.25, 0.25], [3, 1.5], [4, 2], [4.5, 3], [7.125, 3.75], [8, 4]]) near(frames.place(t), place);
  assert.deepEqual([-5, 20, NaN].map((t) => frames.place(t)), [0, 4, 0]);
  assert.deepEqual([1.4, 1.6, 4.2, 4.3, 7].map((t) => frames.nearest(t)), [0, 1, 2, 3, 4]);
});

const row = {
  t: 3, quaternion: [0.5, -0.5, 0.5, 0.5], contact: [1, 2], com: [3, 4, 5], theta: 2.5, force: [3, 4, 12], omega: [-2, 3, 6], momentum: [1, 2, 2], regime: 2,
};
const arrays = ({ quaternion, contact, com, theta, force, omega, momentum }) =>
  [quaternion.toArray(), contact.toArray(), com.toArray(), [theta], ...[force, omega, momentum].map((vector) => vector.toArray())];

test("on a row the pose is that of the row", () => {
  const two = new Frames(motion([{ t: 0 }, row])), pose = emptyPose();
  two.read(1, pose);
  assert.deepEqual(arrays(pose), [row.quaternion, [...row.contact, 0], row.com, [row.theta], row.force, row.omega, row.momentum]);
  assert.equal(pose.regime, 2);
  assert.deepEqual(two.contact(1), row.contact);
  two.com(1, (...at) => assert.deepEqual(at, row.com));
  assert.deepEqual(two.scales, { force: 13, omega: 7, momentum: 3 }); // Pythagoras in whole numbers
});

test("between two rows the pose is interpolated: at a constant rate of rotation, the shorter way, and along a line", () => {
  const turned = (angle, sign = 1) => [0, 0, sign * Math.sin(angle / 2), sign * Math.cos(angle / 2)]; // about z
  for (const sign of [1, -1]) { // both are the same rotation
    const other = { ...row, contact: [-1, 6], com: [1, 1, 1], theta: 0.5, force: [0, 2, 0], omega: [5, 5, 5], momentum: [-3, 0, 1], regime: 1 };
    const rows = [row, { ...other, quaternion: turned(0.4) }, { ...row, quaternion: turned(2.4, sign) }, other];
    const four = new Frames(motion(rows)), pose = emptyPose();
    const vectors = ({ contact, com, theta, force, omega, momentum }) => [...contact, 0, ...com, theta, ...force, ...omega, ...momentum];
    for (const share of [0.25, 0.5, 0.9]) {
      four.read(1 + share, pose);
      near(pose.quaternion.toArray(), turned(0.4 + 2 * share));
      near(arrays(pose).slice(1).flat(), vectors(row).map((value, i) => share * value + (1 - share) * vectors(other)[i]));
      assert.equal(pose.regime, 1); // until the row with another one
    }
  }
});

test("without a motion there are no rows", () => {
  const none = new Frames();
  assert.deepEqual([none.count, none.start, none.end, none.scales.force], [0, 0, 0, 0]);
});

test("the centre of the sphere is above the contact, or follows from G and the axis", () => {
  const pose = emptyPose();
  pose.contact.set(0.5, -0.25, 0);
  pose.com.set(1, 2, 3);
  pose.quaternion.set(Math.SQRT1_2, 0, 0, Math.SQRT1_2); // axis 3 along -y
  near(centreOf(pose, null, new Vector3()).toArray(), [0.5, -0.25, 1]);
  near(centreOf(pose, 0.25, new Vector3()).toArray(), [1, 1.75, 3]);
});

test("a motion can begin with its axis leaning any way: it is turned as a whole about its first contact", () => {
  const { x, y, z, w } = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), 0.5); // towards x
  const at = (t, contact) => ({ t, quaternion: [x, y, z, w], contact, com: [...contact, 1], theta: 0.5, force: [3, 0, 1], omega: [1, 0, 0], momentum: [0, 2, 0] });
  const bytes = motion([at(0, [1, 2]), at(1, [2, 2])]), turned = new Frames(bytes, Math.PI / 2), pose = emptyPose();
  turned.read(1, pose);
  const is = (vector, expected) => vector.toArray().forEach((each, i) => near(each, expected[i], 1e-6));
  is(new Vector3(0, 0, 1).applyQuaternion(pose.quaternion), [0, Math.sin(0.5), Math.cos(0.5)]);
  is(pose.contact, [1, 3, 0]);
  is(pose.com, [1, 3, 1]);
  is(pose.force, [0, 3, 1]);
  is(pose.omega, [0, 1, 0]);
  is(pose.momentum, [-2, 0, 0]);
  new Frames(bytes).read(1, pose); // what was sent is as it was
  is(pose.contact, [2, 2, 0]);
});

test("the handle is searched downhill on the sphere", () => {
  const aim = new Vector3(0.6, -0.64, 0.48), away = (n) => n.distanceTo(aim);
  assert.ok(away(nearest(away, new Vector3(-0.1, 0.2, 0.97).normalize())) < 1e-3);
});
