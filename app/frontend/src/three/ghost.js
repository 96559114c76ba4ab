// The earlier run at the same moment, pale: it has no shadow, and hides nothing.
import { float32 } from "../data.js";
import { centreOf, emptyPose, Frames } from "../motion/frames.js";
import { Body } from "./body.js";
/** @import { Stage } from "./stage.js" */

const PALE = 0.28;

export class Ghost {
  /** @param {Stage} stage */
  constructor(stage) {
    this.stage = stage;
    this.body = new Body();
    Object.assign(this.body.material, { transparent: true, opacity: PALE, depthWrite: false });
    Object.assign(this.body, { castShadow: false, visible: false, renderOrder: 3 });
    this.frames = new Frames();
    this.moment = emptyPose();
    this.seconds = 1;
    /** @type {number | null} */
    this.a = null;
    stage.scene.add(this.body);
  }

  /** @param {Before | null} before @param {number} [azimuth] as of Frames */
  show(before, azimuth) {
    this.frames = new Frames(before?.frames, azimuth);
    this.body.visible = this.frames.count > 0;
    if (before) {
      this.seconds = before.seconds;
      this.a = before.a;
      this.body.setProfile(float32(before.profile));
    }
    this.stage.invalidate();
  }

  // Shows it at a time in units of the top; one unit is `seconds` long. Constant before its start and after its end.
  /** @param {number} t @param {number} seconds */
  follow(t, seconds) {
    if (!this.body.visible) return;
    const { moment, body, frames } = this;
    frames.read(frames.place((t * seconds) / this.seconds), moment);
    body.quaternion.copy(moment.quaternion);
    centreOf(moment, this.a, body.position);
  }
}
