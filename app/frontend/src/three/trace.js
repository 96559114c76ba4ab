// The trace on the ball: a strip on its surface, which turns with it.
import { Vector3 } from "three";
import { colours } from "../colours.js";
import { passedBy, traceOf } from "../motion/trace.js";
import { Ribbon } from "./ribbon.js";

const OVER = 1.006; // R from the centre: so that the ball does not hide it

export class TraceLine extends Ribbon {
  constructor() {
    super(0.035, { color: colours.theta, opacity: 0.9 });
    /** @type {import("../motion/trace.js").Trace | null} */
    this.trace = null;
  }

  // A new motion: its trace is computed once somebody looks at it.
  forget() {
    this.trace = null;
  }

  // Shows it up to a place among the frames.
  /** @param {import("../motion/frames.js").Frames} frames @param {number | null} a @param {number} place @param {boolean} visible */
  showTo(frames, a, place, visible) {
    if (visible && !this.trace) this.read(traceOf(frames, a));
    this.points = visible && this.trace ? passedBy(this.trace, place) : 0;
  }

  /** @param {import("../motion/trace.js").Trace} trace */
  read(trace) {
    this.trace = trace;
    const { marks, on } = trace, n = marks.length, across = new Vector3(), at = new Vector3(), side = new Vector3();
    this.reserve(n);
    if (!n) return;
    const { position } = this.geometry.attributes;
    for (let i = 0; i < n; i++) {
      const joined = on[i] && i > 0 && on[i - 1];
      if (on[i]) at.copy(marks[i]).setLength(OVER); // off the ball it stays where it was, without a width
      if (joined) across.subVectors(marks[i], marks[i - 1]).cross(marks[i]).setLength(this.halfWidth);
      else across.set(0, 0, 0);
      position.setXYZ(2 * i, ...side.addVectors(at, across).toArray());
      position.setXYZ(2 * i + 1, ...side.subVectors(at, across).toArray());
    }
    position.needsUpdate = true;
  }
}
