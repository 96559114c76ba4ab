// A push as an arrow at the point of the top that is touched, with its size: under a hand, and again whenever the run
// comes to it.
import { Vector3 } from "three";
import { Arrow } from "./arrow.js";
import { colours } from "../colours.js";
/** @import { Stage } from "./stage.js" */
/** @import { TopScene } from "./top_scene.js" */

export const PUSH = 0.4; // M (gR)^1/2, of an arrow that is as long as R
const UPRIGHT = 1e-4; // below this sine of the tilt 1' is x, as in model/pushes.py
const SEEN = 0.6, SAME = 1e-6; // s that it is seen, on the clock of the page; of a time that is rounded
export const up = new Vector3(0, 0, 1);

// The axes that turn with the top: 1', the one that with it and `third` is right-handed, and `third`, z or the top's own.
/** @param {Vector3} axis of the top @param {Vector3} third */
function axes(axis, third) {
  const first = Math.hypot(axis.x, axis.y) > UPRIGHT ? new Vector3(-axis.y, axis.x, 0).normalize() : new Vector3(1, 0, 0);
  return [first, third.clone().cross(first), third];
}

// A vector in space along these axes, and one that is given along them in space.
/** @param {Vector3} vector @param {Vector3} axis @param {Vector3} third */
export const along = (vector, axis, third) => axes(axis, third).map((each) => vector.dot(each));
/** @param {number[]} parts @param {Vector3} axis @param {Vector3} third */
export const inSpace = (parts, axis, third) => axes(axis, third).reduce((sum, each, i) => sum.addScaledVector(each, parts[i]), new Vector3());

export class Impulse {
  /** @param {Stage} stage @param {TopScene} scene */
  constructor(stage, scene) {
    this.scene = scene;
    this.point = new Vector3(); // in space
    this.vector = new Vector3(); // of the arrow, in R
    this.arrow = new Arrow(colours.accent, { radius: 0.04, through: 0.85 });
    this.label = scene.labels.add("", "point");
    Object.assign(this.label, { shift: [0, -32], margin: 40 }); // px from the edge of the picture, where the tip is outside
    stage.scene.add(this.arrow);
    this.hide();
  }

  get axis() { return up.clone().applyQuaternion(this.scene.body.quaternion); }

  /** @param {string} wording */
  show(wording) {
    const { arrow, label, point, vector: { x, y, z } } = this;
    arrow.point(point, x, y, z, label.at);
    arrow.visible = label.visible = Boolean(arrow.drawable);
    if (label.element.textContent !== wording) label.element.textContent = wording;
  }

  hide() {
    this.arrow.visible = this.label.visible = false;
  }

  // The last push before a time (s), for as long as it is seen at this speed.
  /** @param {Pushed[]} pushes @param {number} t @param {number} speed */
  replay(pushes, t, speed) {
    const { axis, scene: { body } } = this, push = pushes.filter((each) => each.t <= t + SAME).at(-1);
    if (!push || t - push.t > SEEN * speed || !body.visible) return this.hide();
    this.point.copy(inSpace(push.point, axis, axis)).add(body.position);
    this.vector.copy(inSpace(push.impulse, axis, up)).divideScalar(PUSH);
    this.show(push.wording);
  }
}
