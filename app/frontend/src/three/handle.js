// The handle at the end of a top's axis: dragging it, or the arrow keys, request another tilt. While the top moves, it
// is in sight where the pointer is; in Roll, only a paused top has it.
import { Vector3 } from "three";
import { local } from "../data.js";
import { dress } from "../parts.js";
/** @import { Body } from "./body.js" */
/** @import { Labels } from "./labels.js" */
/** @import { Player } from "../motion/player.js" */
/** @import { Stage } from "./stage.js" */

const BEYOND = 0.25; // how far beyond the body, in R
const LEAST = 0.01; // rad: a motion of Roll may not start closer to the vertical, where the lean has no direction
const STRIDE = 0.05, FINEST = 1e-4; // rad: the first and the last step of the search
const KEY_STEP = 0.01;

// The direction at which `away` has a minimum, searched downhill from a direction along the ways that lead on from there.
/** @param {(n: Vector3) => number} away @param {Vector3} from a unit vector @param {(n: Vector3) => Vector3[]} ways unit vectors perpendicular to n */
export function nearest(away, from, ways) {
  let [at, least] = [from, away(from)];
  for (let step = STRIDE; step > FINEST;) {
    const next = ways(at).flatMap((way) => [step, -step].map((by) => at.clone().multiplyScalar(Math.cos(by)).addScaledVector(way, Math.sin(by))));
    const better = next.map((n) => /** @type {const} */ ([away(n), n])).find(([far]) => far < least);
    if (better) [least, at] = better;
    else step /= 2;
  }
  return at;
}

// Two directions perpendicular to n and to each other.
/** @param {Vector3} n */
function tangents(n) {
  const one = new Vector3(Math.abs(n.x) < 0.5 ? 1 : 0, Math.abs(n.x) < 0.5 ? 0 : 1, 0).cross(n).normalize();
  return [one, one.clone().cross(n)];
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
    this.wanted = new Vector3();
    this.t = this.theta = this.reach = 0;
    this.held = this.requested = false;
    this.tilt = ""; // as it was written last
    this.label = labels.add("", "handle");
    const { element } = this.label;
    element.removeAttribute("aria-hidden");
    for (const by of ["animationend", "pointerdown", "keydown"]) element.addEventListener(by, () => element.classList.add("found"));
    dress(element, { tabindex: 0, role: "slider", "aria-label": model.texts.handle, "aria-valuemin": 0, "aria-valuemax": this.wording(Math.PI), title: model.texts.handle_hint });
    element.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      element.focus({ preventScroll: true });
      element.setPointerCapture(event.pointerId);
      this.take();
      this.held = true;
    });
    element.onpointermove = (event) => this.held && this.pull(event);
    element.onpointerup = element.onpointercancel = element.onlostpointercapture = () => this.letGo();
    element.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -KEY_STEP, ArrowLeft: -KEY_STEP, ArrowDown: KEY_STEP, ArrowRight: KEY_STEP }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation(); // here the arrow keys do not move the clock
      this.take();
      this.ask(Math.min(Math.max(this.theta + step, 0), Math.PI));
      this.requested = true;
    });
  }

  // The tilt for a screen reader.
  /** @param {number} theta */
  wording(theta) {
    return this.model.degrees ? ((180 / Math.PI) * theta).toFixed(0) : local(theta.toFixed(3));
  }

  letGo() {
    if (!this.held) return;
    this.held = false;
    this.model.letGo?.();
  }

  // What is being dragged, the vertical plane through the axis, and the moment.
  take() {
    this.grasp += 1;
    this.t = this.player.t;
    const { x, y } = this.axis, lean = Math.hypot(x, y);
    if (lean > 1e-6) this.lean = [x / lean, y / lean]; // upright: where it leaned last
    this.wanted.copy(this.axis);
  }

  /** @param {Pick<PointerEvent, "clientX" | "clientY">} event */
  pull(event) {
    const { x, y, z } = this.under(event), beside = Math.hypot(x, y);
    if (this.model.degrees && beside > LEAST) this.lean = [x / beside, y / beside];
    this.ask(Math.acos(Math.min(Math.max(z, -1), 1)));
  }

  /** @param {number} theta */
  ask(theta) {
    const least = this.model.degrees ? 0 : LEAST, [x, y] = this.lean;
    const tilt = Math.min(Math.max(theta, least), Math.PI - least);
    this.model.tilted = this.model.degrees ? [tilt, this.t, this.grasp, Math.atan2(y, x)] : [tilt, this.t, this.grasp];
  }

  // The direction of the axis for which the handle is closest to the pointer on the screen, searched from the last one
  // on. In Roll it stays in the plane in which it leans: beyond the vertical a tilt gives the same motion as before it.
  /** @param {Pick<PointerEvent, "clientX" | "clientY">} event */
  under({ clientX, clientY }) {
    const { camera, width, height, holder } = this.stage, box = holder.getBoundingClientRect(), point = new Vector3();
    const { model: { degrees }, lean: [u, v] } = this;
    const away = (n) => {
      if (!degrees && u * n.x + v * n.y < 0) return Infinity;
      point.copy(n).multiplyScalar(this.reach).add(this.from).project(camera);
      return Math.hypot(((point.x + 1) / 2) * width - (clientX - box.left), ((1 - point.y) / 2) * height - (clientY - box.top));
    };
    const inPlane = (n) => new Vector3(u * n.z, v * n.z, -(u * n.x + v * n.y));
    this.wanted = nearest(away, this.wanted, (n) => (degrees ? tangents(n) : [inPlane(n)]));
    return this.wanted;
  }

  // Whether the new motion is the one that was requested here; then it stays at its beginning.
  begins() {
    const mine = this.held || this.requested;
    this.requested = false;
    return mine;
  }

  // The present position of the body, and its tilt.
  /** @param {Body} body @param {number} theta @param {boolean} some whether there is a motion @param {boolean} moves whether it plays */
  follow(body, theta, some, moves) {
    const { element } = this.label;
    this.label.visible = some && (this.model.degrees || !moves);
    element.classList.toggle("moves", moves);
    this.from.copy(body.position);
    this.axis.set(0, 0, 1).applyQuaternion(body.quaternion);
    this.theta = theta;
    this.reach = (body.top ?? 1) + BEYOND;
    this.label.at.copy(this.axis).multiplyScalar(this.reach).add(this.from);
    const wording = this.wording(this.held ? (this.model.tilted[0] ?? theta) : theta); // of the hand, which its run follows later
    if (wording === this.tilt) return; // nothing to write in most frames
    this.tilt = wording;
    element.setAttribute("aria-valuenow", wording);
    element.dataset.wording = this.model.degrees ? `${wording}°` : wording;
  }
}
