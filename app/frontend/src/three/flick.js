// A hand on the top itself. While it moves, a flick pushes it: the arrow is the impulse, at the point that was touched, in
// the plane of the picture. At rest, a flick along the turn of the stem spins it. How far the flick goes is how strong
// it is, not how fast: a slow hand can do it too. Keys push at the middle of its axis.
import { Raycaster, Vector2, Vector3 } from "three";
import { along, PUSH, up } from "./impulse.js";
/** @import { Impulse } from "./impulse.js" */
/** @import { Stage } from "./stage.js" */
/** @import { TopScene } from "./top_scene.js" */
/** @import { Player } from "../motion/player.js" */

const LEAST = 8; // px: a shorter flick is none
const KEY_PUSH = 0.25; // M (gR)^1/2
const TURNS = 30; // rev/s for one as long as R
const STILL = 0.02; // (g/R)^1/2: with less it is at rest
const KEYS = { ArrowUp: [0, 1], ArrowLeft: [-1, 0], ArrowDown: [0, -1], ArrowRight: [1, 0] }; // to the right, and away

// The spin (rev/s) of a flick at a point, seen from a point of the axis: as far as it goes the way that the point turns.
/** @param {Vector3} flick @param {Vector3} axis @param {Vector3} point */
export const turnsOf = (flick, axis, point) => TURNS * flick.dot(axis.clone().cross(point).normalize());

export class Flick {
  /** @param {Stage} stage @param {TopScene} scene @param {Player} player @param {Hand} hand @param {Impulse} impulse */
  constructor(stage, scene, player, hand, impulse) {
    const canvas = stage.renderer.domElement;
    this.stage = stage;
    this.scene = scene;
    this.player = player;
    this.hand = hand;
    this.ray = new Raycaster();
    this.impulse = impulse;
    this.from = /** @type {number[] | null} */ (null); // where a hand is on the top, px
    this.mark = new Vector3(); // there, in the body
    this.waits = false; // whether the motion has still to go on from a push
    this.wording = "";
    const capture = { capture: true }; // before the camera hears of it
    stage.holder.addEventListener("pointerdown", (event) => event.target === canvas && this.press(event), capture);
    // A finger that is on the top pushes it up and down too; elsewhere it scrolls the page.
    stage.holder.addEventListener("touchstart", (event) => this.from && event.cancelable && event.preventDefault(), { passive: false });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", () => this.letGo());
    for (const end of ["pointercancel", "lostpointercapture"]) canvas.addEventListener(end, () => this.cancel());
    canvas.addEventListener("keydown", (event) => this.key(event));
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
    this.mark.copy(this.scene.body.worldToLocal(this.impulse.point.copy(point).clone()));
    this.impulse.vector.set(0, 0, 0);
    this.hand.hold(true);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { from, stage: { camera, height, renderer }, impulse: { point, vector } } = this, column = (i) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i);
    if (!from) {
      if (!event.buttons) renderer.domElement.style.cursor = this.touched(event) ? "grab" : "";
      return;
    }
    const [x, y] = [event.clientX - from[0], event.clientY - from[1]];
    const R = (2 * camera.position.distanceTo(point) * Math.tan((camera.fov * Math.PI) / 360)) / height; // of one px there
    vector.set(0, 0, 0);
    if (Math.hypot(x, y) >= LEAST) vector.addScaledVector(column(0), x * R).addScaledVector(column(1), -y * R);
    this.show(this.spins ? this.hand.turnsText(this.turns) : this.hand.sizeText(PUSH * vector.length()));
  }

  get turns() {
    const { vector, axis, point } = this.impulse;
    return turnsOf(vector, axis, point.clone().sub(this.scene.body.position));
  }

  /** @param {string} wording */
  show(wording) {
    this.wording = wording;
    this.impulse.show(wording);
    this.stage.invalidate();
  }

  letGo() {
    const { impulse: { vector }, hand, spins, turns } = this;
    if (!this.from || !vector.length()) return this.cancel();
    this.end();
    if (spins) {
      hand.hold(false);
      this.impulse.hide();
      hand.spin(turns);
    } else this.push(vector.clone().multiplyScalar(PUSH));
  }

  // The picture is held until it goes on from there.
  /** @param {Vector3} impulse in M (gR)^1/2 */
  push(impulse) {
    const { impulse: { axis, point }, scene: { body } } = this;
    this.waits = true;
    this.hand.push(along(point.clone().sub(body.position), axis, axis), along(impulse, axis, up));
  }

  end() {
    this.from = null;
    this.stage.controls.enableRotate = true;
  }

  cancel() {
    if (!this.from) return;
    this.end();
    this.impulse.hide();
    this.hand.hold(false);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const way = event.altKey && event.shiftKey && KEYS[event.key], { stage: { camera }, scene: { body }, impulse: { axis, point, vector } } = this;
    if (event.key === "Escape" && this.from) this.cancel();
    if (!way || event.metaKey || event.ctrlKey || this.from || !body.visible || event.repeat) return;
    event.preventDefault();
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0).setZ(0).normalize(), away = up.clone().cross(right);
    vector.set(0, 0, 0).addScaledVector(right, way[0]).addScaledVector(away, way[1]).multiplyScalar(KEY_PUSH);
    point.copy(axis).multiplyScalar(((body.top ?? 1) - 1) / 2).add(body.position);
    this.hand.hold(true);
    this.push(vector);
    vector.multiplyScalar(1 / PUSH);
    this.show(this.hand.sizeText(KEY_PUSH));
  }

  // Whether the arrow is that of the hand: until the motion goes on.
  follow() {
    this.waits &&= Boolean(this.player.held);
    if (!this.from) return this.waits;
    this.scene.body.updateMatrixWorld();
    this.scene.body.localToWorld(this.impulse.point.copy(this.mark));
    this.impulse.show(this.wording);
    return true;
  }
}
