// What of a run can be heard: how it rubs, how fast it turns, and the impulses of what touches the table.
import { Vector3 } from "three";
import { emptyPose } from "./frames.js";

/** Whether a person wants to hear it, in this page. */
export const listening = { on: false };
const LEAST = 0.03; // M (g R)^1/2: an impulse below this is not heard

/**
 * @typedef {object} Heard one value a frame
 * @property {number[]} slip of the point that touches, in (g R)^1/2
 * @property {number[]} rub slip times friction, in M g (g R)^1/2
 * @property {number[]} turn the angular velocity, in (g/R)^1/2
 * @property {[place: number, impulse: number][]} touches the table's impulses upwards, in M (g R)^1/2, and their places
 */

/** @param {import("./frames.js").Frames} frames @returns {Heard} */
export function heardOf(frames) {
  const heard = /** @type {Heard} */ ({ slip: [], rub: [], turn: [], touches: [] }), pose = emptyPose();
  const last = frames.count - 1, arm = new Vector3(), v = new Vector3(), from = new Vector3(), to = new Vector3();
  // the velocity of G from frame i to the next
  const rate = (i, out) => {
    frames.com(i, (x, y, z) => from.set(x, y, z));
    frames.com(i + 1, (x, y, z) => to.set(x, y, z));
    return out.subVectors(to, from).divideScalar(frames.time(i + 1) - frames.time(i) || 1);
  };
  const before = new Vector3(), after = new Vector3();
  for (let i = 0; i <= last; i++) {
    frames.read(i, pose);
    rate(Math.max(Math.min(i, last - 1), 0), after);
    if (!i) before.copy(after);
    // v + omega x r, of what touches
    v.addVectors(before, after).multiplyScalar(0.5).add(arm.crossVectors(pose.omega, to.subVectors(pose.contact, pose.com)));
    const slip = Math.hypot(v.x, v.y), carries = pose.force.z > 0;
    heard.slip.push(carries ? slip : 0);
    heard.rub.push(carries ? slip * Math.hypot(pose.force.x, pose.force.y) : 0);
    heard.turn.push(pose.omega.length());
    // d(v_z) = (F_z - 1) dt, and an impulse where it is more
    const dt = i && i < last ? (frames.time(i + 1) - frames.time(i - 1)) / 2 : 0, impulse = after.z - before.z - (pose.force.z - 1) * dt;
    if (dt && impulse > LEAST) heard.touches.push([i, impulse]);
    before.copy(after);
  }
  return heard;
}
