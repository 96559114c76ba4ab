// Mouse and touch on Fig. 5: reads values off the surface, selects motions, and drags the selected tieline.
import * as THREE from "three";
import { coalesce } from "../data.js";
/** @import { Surface } from "./surface3d.js" */

const CLICK_PX = 4; // px: a press that moves less than this is a click, not a rotation
const GRIP_PX = 14;

// Which part of a tieline the pointer grabs. a, b: its ends relative to the pointer, in px.
/** @param {number[]} a @param {number[]} b @returns {"end" | "line" | null} */
export function gripBetween(a, b) {
  if (Math.min(Math.hypot(...a), Math.hypot(...b)) < GRIP_PX) return "end";
  const along = [b[0] - a[0], b[1] - a[1]], length = along[0] ** 2 + along[1] ** 2 || 1;
  const share = Math.min(Math.max(-(a[0] * along[0] + a[1] * along[1]) / length, 0), 1);
  return Math.hypot(a[0] + share * along[0], a[1] + share * along[1]) < GRIP_PX / 2 ? "line" : null;
}

export class SurfaceHand {
  /** @param {Surface} surface @param {AbortSignal} life */
  constructor(surface, life) {
    const { picture, stage } = surface;
    this.surface = surface;
    this.picture = picture;
    this.canvas = stage.renderer.domElement;
    this.ray = new THREE.Raycaster();
    this.pointer = new THREE.Vector2();
    this.corner = new THREE.Vector3();
    this.floor = new THREE.Plane(new THREE.Vector3(0, 0, 1), 0);
    this.foot = new THREE.Vector3();
    /** @type {"end" | "line" | null} */
    this.gripped = null;
    this.pressed = this.last = /** @type {PointerEvent | null} */ (null);
    this.hover = coalesce(() => this.read(), life);
    this.pull = coalesce(() => this.ask(), life);
    this.listen();
  }

  listen() {
    const { picture, canvas } = this;
    // Runs before the camera's own listener, so that dragging a tieline does not also turn the camera.
    picture.addEventListener("pointerdown", (event) => this.take(event), { capture: true });
    // A finger that drags the tieline does not scroll the page.
    const keep = (/** @type {TouchEvent} */ event) =>
      event.touches.length === 1 && this.gripUnder(event.touches[0]) && event.preventDefault();
    picture.addEventListener("touchstart", keep, { passive: false });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerleave", () => this.gripped || this.leave());
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => this.release());
    canvas.addEventListener("pointerdown", (event) => (this.pressed = this.gripped ? null : event));
    canvas.addEventListener("pointerup", (event) => this.click(event));
  }

  /** @param {PointerEvent} event */
  take(event) {
    const { controls } = this.surface.stage;
    this.gripped = event.isPrimary && event.button === 0 ? this.gripUnder(event) : null;
    controls.enabled = !this.gripped;
    if (!this.gripped) return;
    this.last = event;
    this.canvas.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  move(event) {
    this.last = event;
    if (this.gripped) return this.pull();
    if (event.buttons) return this.leave(); // rotating, not reading
    this.canvas.style.cursor = this.gripUnder(event) ? "move" : "";
    this.hover();
  }

  release() {
    if (!this.gripped) return;
    this.gripped = null;
    this.surface.stage.controls.enabled = true;
    this.leave();
  }

  /** @param {PointerEvent} event */
  click(event) {
    const { pressed, surface: { model, grid } } = this;
    if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > CLICK_PX) return;
    const i = this.under(event), place = i === null ? this.onFloor(event) : null;
    if (place) model.hand = ["point", ...place];
    else if (i !== null) model.hand = ["tieline", grid.theta[i], grid.K_J[Math.floor(i / grid.columns)]];
    this.last = event;
    this.hover(); // a finger cannot hover, so a tap reads the value too
  }

  leave() {
    this.hover.cancel();
    this.surface.readNothing();
  }

  // New values under a mouse that rests.
  refresh() {
    if (this.surface.readout && this.last && !this.gripped) this.hover();
  }

  // Shows the values of the surface under the pointer; beyond the ends of the tielines, why there is no surface. Where
  // nothing limits the motions there is no surface either.
  read() {
    const { surface, last } = this;
    if (!last) return;
    const i = this.under(last);
    if (i !== null) return surface.readValue(i, last);
    const place = surface.grid.rows > 1 && this.onFloor(last);
    if (place && surface.grid.on(place) === null) surface.readWhyNot(place, last);
    else this.leave();
  }

  // Requests the motion at the pointer.
  ask() {
    const { gripped, surface: { model, scales: { y } }, last } = this, place = gripped && last && this.onFloor(last, true);
    if (!gripped || !place) return;
    model.hand = [gripped, Math.min(Math.max(place[0], 0), Math.PI), Math.min(Math.max(place[1], y.low), y.high)];
    this.say();
  }

  // While dragging: says why the requested motion is impossible, if it is.
  say() {
    if (this.gripped && this.last) this.surface.readWrong(this.last);
  }

  /** @param {{ clientX: number, clientY: number }} event */
  aim({ clientX, clientY }) {
    const box = this.picture.getBoundingClientRect();
    this.pointer.set(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    this.ray.setFromCamera(this.pointer, this.surface.stage.camera);
  }

  // The index of the mesh point closest to the pointer, or null. Through the surface's open side one sees the floor
  // below it: that belongs to it too.
  /** @param {PointerEvent} event */
  under(event) {
    const { surface: { grid, mesh } } = this;
    if (grid.rows < 2) return null;
    this.aim(event);
    const hit = mesh.nearest(this.ray), place = hit === null ? this.onFloor(event) : null, below = place && grid.on(place);
    return hit ?? (below !== null && grid.isReal(Math.floor(below / grid.columns)) ? below : null);
  }

  // The place on the floor under the pointer: [theta, K_J], or null outside the box.
  /** @param {PointerEvent} event @returns {[theta: number, K_J: number] | null} */
  onFloor(event, anywhere = false) {
    const { foot, surface: { scales: { x, y } } } = this;
    this.aim(event);
    if (!this.ray.ray.intersectPlane(this.floor, foot)) return null;
    const inside = foot.x >= x.from && foot.x <= x.to && foot.y >= y.from && foot.y <= y.to;
    return anywhere || inside ? [x.value(foot.x), y.value(foot.y)] : null;
  }

  // The place on the page of a point of the selected tieline.
  /** @param {number} theta */
  onPage(theta) {
    const { corner, surface: { scales: { x, y }, selected, stage } } = this, box = this.picture.getBoundingClientRect();
    corner.set(x.at(theta), y.at(selected.K_J), 0).project(stage.camera);
    return [((corner.x + 1) / 2) * box.width + box.left, ((1 - corner.y) / 2) * box.height + box.top];
  }

  // Which part of the selected tieline, on the floor, is under the pointer: an end, the line, or neither.
  /** @param {{ clientX: number, clientY: number }} event */
  gripUnder({ clientX, clientY }) {
    const { selected: { K_J, inner, outer }, scales: { x } } = this.surface;
    if (!Number.isFinite(K_J)) return null;
    const [a, b] = [inner, outer].map((end) => {
      const [pageX, pageY] = this.onPage(Math.min(end, x.high));
      return [pageX - clientX, pageY - clientY];
    });
    return gripBetween(a, b);
  }
}
