// A hand on the top itself. While it moves, a flick pushes it: the arrow is the impulse, at the point that was touched, in
// the plane of the picture. At rest, a flick along the turn of the stem spins it. How far the flick goes is how strong
// it is, not how fast: a slow hand can do it too. Keys push at the middle of its axis.
import { Raycaster, Vector2, Vector3 } from "three";
import { Arrow } from "./arrow.js";
import { colours } from "../colours.js";
/** @import { Stage } from "./stage.js" */
/** @import { TopScene } from "./top_scene.js" */
/** @import { Player } from "../motion/player.js" */

const LEAST = 8; // px: a shorter flick is none
const PUSH = 0.4, KEY_PUSH = 0.25; // M (gR)^1/2: for a flick that is as long as R, and of a key
const TURNS = 30; // rev/s for one as long as R
const STILL = 0.02; // (g/R)^1/2: with less it is at rest
const UPRIGHT = 1e-4; // below this sine of the tilt, 1' is where Python has it at a pole
const KEYS = { ArrowUp: [0, 1], ArrowLeft: [-1, 0], ArrowDown: [0, -1], ArrowRight: [1, 0] }; // to the right, and away
const up = new Vector3(0, 0, 1);

// A vector in space along the axes that turn with the top: 1', and the one that with it and `third` is right-handed.
/** @param {Vector3} vector @param {Vector3} axis of the top @param {Vector3} third z, or the axis @returns {[number, number, number]} */
export function along(vector, axis, third) {
  const first = Math.hypot(axis.x, axis.y) > UPRIGHT ? new Vector3(-axis.y, axis.x, 0).normalize() : new Vector3(1, 0, 0);
  return [vector.dot(first), vector.dot(third.clone().cross(first)), vector.dot(third)];
}

// The spin (rev/s) of a flick at a point, seen from a point of the axis: as far as it goes the way that the point turns.
/** @param {Vector3} flick @param {Vector3} axis @param {Vector3} point */
export const turnsOf = (flick, axis, point) => TURNS * flick.dot(axis.clone().cross(point).normalize());

export class Flick {
  /** @param {Stage} stage @param {TopScene} scene @param {Player} player @param {Hand} hand */
  constructor(stage, scene, player, hand) {
    const canvas = stage.renderer.domElement;
    this.stage = stage;
    this.scene = scene;
    this.player = player;
    this.hand = hand;
    this.ray = new Raycaster();
    this.from = /** @type {number[] | null} */ (null); // where a hand is on the top, px
    this.point = new Vector3(); // in space, and in the body
    this.mark = new Vector3();
    this.vector = new Vector3();
    this.arrow = new Arrow(colours.accent, { radius: 0.04, through: 0.85 });
    this.label = scene.labels.add("", "point");
    this.label.shift = [0, -32];
    stage.scene.add(this.arrow);
    this.hide();
    const capture = { capture: true }; // before the camera hears of it
    stage.holder.addEventListener("pointerdown", (event) => event.target === canvas && this.press(event), capture);
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", () => this.letGo());
    for (const end of ["pointercancel", "lostpointercapture"]) canvas.addEventListener(end, () => this.cancel());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  get axis() {
    return up.clone().applyQuaternion(this.scene.body.quaternion);
  }

  get spins() {
    const { player, scene } = this;
    return !player.playing && (player.t <= player.frames.start || scene.moment.omega.length() < STILL);
  }

  // The point of the top under the pointer, if there is one.
  /** @param {PointerEvent} event */
  touched({ clientX, clientY }) {
    const { stage: { camera, holder, width, height }, scene: { body }, ray } = this, box = holder.getBoundingClientRect();
    if (!body.visible) return undefined;
    ray.setFromCamera(new Vector2((2 * (clientX - box.left)) / width - 1, 1 - (2 * (clientY - box.top)) / height), camera);
    body.updateMatrixWorld();
    return ray.intersectObject(body)[0]?.point;
  }

  /** @param {PointerEvent} event */
  press(event) {
    if (this.from) return this.cancel(); // a second finger zooms
    const point = event.button ? undefined : this.touched(event);
    if (!point) return;
    this.stage.controls.enableRotate = false;
    this.from = [event.clientX, event.clientY];
    this.mark.copy(this.scene.body.worldToLocal(this.point.copy(point).clone()));
    this.vector.set(0, 0, 0);
    this.hand.hold(true);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { from, stage: { camera, height, renderer }, point, vector } = this, column = (i) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i);
    if (!from) {
      if (!event.buttons) renderer.domElement.style.cursor = this.touched(event) ? "grab" : "";
      return;
    }
    const [x, y] = [event.clientX - from[0], event.clientY - from[1]];
    const R = (2 * camera.position.distanceTo(point) * Math.tan((camera.fov * Math.PI) / 360)) / height; // of one px there
    vector.set(0, 0, 0);
    if (Math.hypot(x, y) >= LEAST) vector.addScaledVector(column(0), x * R).addScaledVector(column(1), -y * R);
    this.show(this.spins ? this.hand.saidTurns(this.turns) : this.hand.saidSize(PUSH * vector.length()));
  }

  get turns() {
    return turnsOf(this.vector, this.axis, this.point.clone().sub(this.scene.body.position));
  }

  /** @param {string} said */
  show(said) {
    const { arrow, label, stage } = this;
    this.place();
    arrow.visible = label.visible = Boolean(arrow.drawable);
    if (label.element.textContent !== said) label.element.textContent = said;
    stage.invalidate();
  }

  place() {
    const { arrow, label, point, vector: { x, y, z } } = this;
    arrow.point(point, x, y, z, label.at);
  }

  letGo() {
    const { vector, hand } = this, { spins, turns } = this;
    if (!this.from || !vector.length()) return this.cancel();
    this.end();
    if (spins) {
      hand.hold(false);
      this.hide();
      hand.spin(turns);
    } else this.push(vector.clone().multiplyScalar(PUSH));
  }

  // The picture is held until it goes on from there.
  /** @param {Vector3} impulse in M (gR)^1/2 */
  push(impulse) {
    const { axis, point, scene: { body } } = this;
    this.hand.push(along(point.clone().sub(body.position), axis, axis), along(impulse, axis, up));
  }

  end() {
    this.from = null;
    this.stage.controls.enableRotate = true;
  }

  cancel() {
    if (!this.from) return;
    this.end();
    this.hide();
    this.hand.hold(false);
  }

  hide() {
    this.arrow.visible = this.label.visible = false;
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const way = event.ctrlKey && event.shiftKey && KEYS[event.key], { stage: { camera }, scene: { body }, vector } = this;
    if (event.key === "Escape" && this.from) this.cancel();
    if (!way || event.metaKey || event.altKey || this.from || !body.visible || event.repeat) return;
    event.preventDefault();
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0).setZ(0).normalize(), away = up.clone().cross(right);
    vector.set(0, 0, 0).addScaledVector(right, way[0]).addScaledVector(away, way[1]).multiplyScalar(KEY_PUSH);
    this.point.copy(this.axis).multiplyScalar(((body.top ?? 1) - 1) / 2).add(body.position);
    this.hand.hold(true);
    this.push(vector);
    vector.multiplyScalar(1 / PUSH);
    this.show(this.hand.saidSize(KEY_PUSH));
  }

  // The arrow stays until the motion goes on.
  follow() {
    if (this.from) {
      this.scene.body.updateMatrixWorld();
      this.scene.body.localToWorld(this.point.copy(this.mark));
      this.place();
    } else if (!this.player.held) this.hide();
  }
}
