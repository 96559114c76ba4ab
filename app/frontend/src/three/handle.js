// The handle at the end of a paused top's axis: dragging it, or the arrow keys, request another tilt.
import { Vector3 } from "three";
import { local } from "../data.js";
/** @import { Body } from "./body.js" */
/** @import { Labels } from "./labels.js" */
/** @import { Player } from "../motion/player.js" */
/** @import { Stage } from "./stage.js" */

const BEYOND = 0.25; // how far beyond the body, in R
const LEAST = 0.01; // rad: a motion of Roll may not start closer to the vertical, where the lean has no direction
const STRIDE = 0.05, FINEST = 1e-4; // rad: the first and the last step of the search
const KEY_STEP = 0.01;

// The place of a minimum of `away`, searched downhill from a place.
/** @param {(at: number) => number} away @param {number} from */
export function nearest(away, from) {
  let [at, least] = [from, away(from)];
  for (let step = STRIDE; step > FINEST;) {
    const better = [at - step, at + step].find((next) => away(next) < least);
    if (better === undefined) step /= 2;
    else [at, least] = [better, away(better)];
  }
  return at;
}

export class Handle {
  /** @param {Stage} stage @param {Labels} labels @param {TopModel} model @param {Player} player */
  constructor(stage, labels, model, player) {
    this.stage = stage;
    this.model = model;
    this.player = player;
    this.grasp = 0;
    this.axis = new Vector3();
    this.from = new Vector3();
    this.lean = [1, 0];
    this.t = this.theta = this.wanted = this.reach = 0;
    this.held = this.asked = false;
    this.label = labels.add("", "handle");
    const { element } = this.label;
    element.tabIndex = 0;
    element.removeAttribute("aria-hidden");
    element.setAttribute("role", "slider");
    element.setAttribute("aria-label", model.texts.handle);
    element.setAttribute("aria-valuemin", "0");
    element.setAttribute("aria-valuemax", this.said(Math.PI));
    element.title = model.texts.handle_hint;
    element.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      element.focus({ preventScroll: true });
      element.setPointerCapture(event.pointerId);
      this.take();
      this.held = true;
    });
    element.addEventListener("pointermove", (event) => this.held && this.ask(this.under(event)));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) element.addEventListener(end, () => this.letGo());
    element.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -KEY_STEP, ArrowLeft: -KEY_STEP, ArrowDown: KEY_STEP, ArrowRight: KEY_STEP }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation(); // here the arrow keys do not move the clock
      this.take();
      this.ask(this.theta + step);
      this.asked = true;
    });
  }

  // The tilt for a screen reader.
  /** @param {number} theta */
  said(theta) {
    return this.model.degrees ? ((180 / Math.PI) * theta).toFixed(0) : local(theta.toFixed(3));
  }

  letGo() {
    if (!this.held) return;
    this.held = false;
    this.model.letGo?.();
  }

  // What is being dragged: the vertical plane through the axis, and the moment.
  take() {
    this.grasp += 1;
    this.t = this.player.t;
    const { x, y } = this.axis, lean = Math.hypot(x, y);
    if (lean > 1e-6) this.lean = [x / lean, y / lean]; // upright: where it leaned last
    this.wanted = this.theta;
  }

  /** @param {number} theta */
  ask(theta) {
    const least = this.model.degrees ? 0 : LEAST;
    this.model.tilted = [Math.min(Math.max(theta, least), Math.PI - least), this.t, this.grasp];
  }

  // The tilt at which the handle is closest to the pointer on the screen, searched from the last one on. Beyond the
  // vertical a tilt gives the same motion as before it, so there the axis stays upright.
  /** @param {PointerEvent} event */
  under({ clientX, clientY }) {
    const { camera, width, height, holder } = this.stage, box = holder.getBoundingClientRect(), point = new Vector3();
    const away = (theta) => {
      if (theta < 0 || theta > Math.PI) return Infinity;
      const s = Math.sin(theta);
      point.set(this.lean[0] * s, this.lean[1] * s, Math.cos(theta)).multiplyScalar(this.reach).add(this.from).project(camera);
      return Math.hypot(((point.x + 1) / 2) * width - (clientX - box.left), ((1 - point.y) / 2) * height - (clientY - box.top));
    };
    this.wanted = nearest(away, this.wanted);
    return this.wanted;
  }

  // Whether the new motion is the one that was requested here; then it stays at its beginning.
  begins() {
    const mine = this.held || this.asked;
    this.asked = false;
    return mine;
  }

  // The present position of the body, and its tilt.
  /** @param {Body} body @param {number} theta @param {boolean} shown */
  follow(body, theta, shown) {
    this.label.visible = shown;
    this.from.copy(body.position);
    this.axis.set(0, 0, 1).applyQuaternion(body.quaternion);
    this.theta = theta;
    this.reach = (body.top ?? 1) + BEYOND;
    this.label.at.copy(this.axis).multiplyScalar(this.reach).add(this.from);
    this.label.element.setAttribute("aria-valuenow", this.said(this.theta));
  }
}
