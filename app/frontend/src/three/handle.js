// The handle at the end of a top's axis: dragging it, or the arrow keys, request another tilt. While the top moves, it
// is in sight where the pointer is.
import { Vector3 } from "three";
import { degrees } from "../data.js";
import { dress } from "../parts.js";
/** @import { Body } from "./body.js" */
/** @import { Labels } from "./labels.js" */
/** @import { Stage } from "./stage.js" */

const BEYOND = 0.25; // how far beyond the body, in R
const LEAST = 0.01; // of a unit vector: closer to the vertical the lean has no direction
const STRIDE = 0.05, FINEST = 1e-4; // rad: the first and the last step of the search
const KEY_STEP = 0.01;

// The direction at which `away` has a minimum, searched downhill from a direction.
/** @param {(n: Vector3) => number} away @param {Vector3} from a unit vector */
export function nearest(away, from) {
  let [at, least] = [from, away(from)];
  for (let step = STRIDE; step > FINEST;) {
    const next = tangents(at).flatMap((way) => [step, -step].map((by) => at.clone().multiplyScalar(Math.cos(by)).addScaledVector(way, Math.sin(by))));
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
  /** @param {Stage} stage @param {Labels} labels @param {Record<string, any>} texts @param {NonNullable<TopModel["pulled"]>} pulled */
  constructor(stage, labels, texts, pulled) {
    this.stage = stage;
    this.pulled = pulled;
    this.axis = new Vector3();
    this.from = new Vector3();
    this.lean = [1, 0];
    this.wanted = new Vector3();
    this.theta = this.asked = this.reach = 0; // asked: the tilt that a hand asked for last
    this.held = this.requested = false;
    this.tilt = ""; // as it was written last
    this.label = labels.add("", "handle");
    const { element } = this.label;
    element.removeAttribute("aria-hidden");
    for (const by of ["animationend", "pointerdown", "keydown"]) element.addEventListener(by, () => element.classList.add("found"));
    dress(element, { tabindex: 0, role: "slider", "aria-label": texts.handle, "aria-valuemin": 0, "aria-valuemax": 180, title: texts.handle_hint });
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

  letGo() {
    if (!this.held) return;
    this.held = false;
    this.pulled.letGo();
  }

  // Where the axis leans as it is taken.
  take() {
    this.asked = this.theta;
    const { x, y } = this.axis, lean = Math.hypot(x, y);
    if (lean > 1e-6) this.lean = [x / lean, y / lean]; // upright: where it leaned last
    this.wanted.copy(this.axis);
  }

  /** @param {Pick<PointerEvent, "clientX" | "clientY">} event */
  pull(event) {
    const { x, y, z } = this.under(event), beside = Math.hypot(x, y);
    if (beside > LEAST) this.lean = [x / beside, y / beside];
    this.ask(Math.acos(Math.min(Math.max(z, -1), 1)));
  }

  /** @param {number} theta */
  ask(theta) {
    const [x, y] = this.lean;
    this.asked = theta;
    this.pulled.to(theta, Math.atan2(y, x));
  }

  // The direction of the axis for which the handle is closest to the pointer on the screen, searched from the last one
  // on.
  /** @param {Pick<PointerEvent, "clientX" | "clientY">} event */
  under({ clientX, clientY }) {
    const { camera, width, height, holder } = this.stage, box = holder.getBoundingClientRect(), point = new Vector3();
    const away = (n) => {
      point.copy(n).multiplyScalar(this.reach).add(this.from).project(camera);
      return Math.hypot(((point.x + 1) / 2) * width - (clientX - box.left), ((1 - point.y) / 2) * height - (clientY - box.top));
    };
    this.wanted = nearest(away, this.wanted);
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
    this.label.visible = some;
    element.classList.toggle("moves", moves);
    this.from.copy(body.position);
    this.axis.set(0, 0, 1).applyQuaternion(body.quaternion);
    this.theta = theta;
    this.reach = (body.top ?? 1) + BEYOND;
    this.label.at.copy(this.axis).multiplyScalar(this.reach).add(this.from);
    const wording = degrees(this.held ? this.asked : theta).toFixed(0); // of the hand, which its run follows later
    if (wording === this.tilt) return; // nothing to write in most frames
    this.tilt = wording;
    element.setAttribute("aria-valuenow", wording);
    element.dataset.wording = `${wording}°`;
  }
}
