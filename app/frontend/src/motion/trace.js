// The trace: where the table touched the ball, in the body's axes, as carbon paper on the table would mark it.
import { Vector3 } from "three";
import { rowBefore } from "../data.js";
import { centreOf, emptyPose } from "./frames.js";

const ON = 2e-3; // R: this near to its surface the ball touches, and not the stem or nothing
const TURN = 0.2; // rad that the body turns between two marks, at most
const MOST = 16; // marks from one frame to the next, at most

/**
 * @typedef {object} Trace
 * @property {number[]} places among the frames, ascending
 * @property {Vector3[]} marks from the centre of the ball, one for each place
 * @property {boolean[]} on whether there is a mark: elsewhere the ball does not touch
 */

/** @type {WeakMap<object, { a: number | null, trace: Trace }>} */
const known = new WeakMap(); // of the bytes of a motion: the top and the map show the same one

/** @param {import("./frames.js").Frames} frames @param {number | null} a as of centreOf() */
export function traceOf(frames, a) {
  const key = frames.bytes ?? frames;
  let found = known.get(key);
  if (found?.a !== a) known.set(key, (found = { a, trace: computed(frames, a) }));
  return found.trace;
}

/** @param {import("./frames.js").Frames} frames @param {number | null} a @returns {Trace} */
function computed(frames, a) {
  const pose = emptyPose(), next = emptyPose(), trace = /** @type {Trace} */ ({ places: [], marks: [], on: [] });
  const touches = (mark) => Math.abs(mark.length() - 1) < ON;
  const markAt = (place) => {
    frames.read(place, pose);
    return centreOf(pose, a, new Vector3()).negate().add(pose.contact).applyQuaternion(pose.quaternion.conjugate());
  };
  const put = (place, mark, on) => {
    trace.places.push(place);
    trace.marks.push(mark);
    trace.on.push(on);
  };
  for (let i = 0; i < frames.count; i++) {
    const mark = markAt(i), isOn = touches(mark);
    put(i, mark, isOn);
    frames.read(i, pose);
    frames.read(i + 1, next);
    const steps = Math.min(Math.ceil(pose.quaternion.angleTo(next.quaternion) / TURN), MOST), staysOn = steps > 1 && isOn && touches(markAt(i + 1));
    for (let k = 1; k < steps; k++) put(i + k / steps, markAt(i + k / steps).normalize(), staysOn);
  }
  return trace;
}

// How many of the places have been passed.
/** @param {Trace} trace @param {number} place */
export function passedBy({ places }, place) {
  if (!(place >= places[0])) return 0;
  return place >= places[places.length - 1] ? places.length : rowBefore(places, place) + 1;
}
