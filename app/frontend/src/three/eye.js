// The camera of a top: it follows the top, and keeps the direction and the distance that a person chose.
import * as THREE from "three";
/** @import { Stage } from "./stage.js" */

const FOLLOW_MS = 160; // it follows the top's path, but not each of its small loops
const FIRST_VIEW = [-1.12, 0.3, 1];
const MIDDLE = 1.25; // R above the table: the point that the camera looks at for a body of reach USUAL
const USUAL = 2, FARTHEST = 22; // R

export class Eye {
  /**
   * @param {Stage} stage
   * @param {TopModel} model
   * @param {THREE.Vector3} stands the centre of the sphere
   * @param {() => number} reach how far the body extends from there
   */
  constructor(stage, model, stands, reach) {
    const { camera, controls } = stage;
    this.camera = camera;
    this.controls = controls;
    this.model = model;
    this.stands = stands;
    this.reach = reach;
    this.seen = new THREE.Vector3(); // the point that the camera looks at
    this.jumps = true; // go to the top at once
  }

  /** @returns {[x: number, y: number, z: number]} */
  get direction() { return this.camera.position.clone().sub(this.seen).normalize().toArray(); }

  /** @param {number} now in ms @param {boolean} playing */
  follow(now, playing) {
    const ms = this.before === undefined ? 0 : now - this.before, { stands, seen } = this;
    this.before = playing ? now : undefined;
    const share = this.jumps || !playing ? 1 : 1 - Math.exp(-ms / FOLLOW_MS);
    this.jumps = false;
    if (this.model.follow) this.move((stands.x - seen.x) * share, (stands.y - seen.y) * share);
  }

  move(dx, dy) {
    const { seen, camera, controls } = this;
    for (const each of [seen, camera.position]) each.set(each.x + dx, each.y + dy, each.z);
    controls.target.copy(seen);
    camera.lookAt(seen);
  }

  // Far enough for the whole top with its stem and the arrows, whatever the shape of the window.
  distance() {
    const half = Math.atan(Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2)) * Math.min(1, this.camera.aspect));
    return this.reach() / Math.sin(half);
  }

  // As Python asks for, otherwise from the side.
  begin() {
    const { seen, camera, controls, model, stands } = this;
    seen.set(stands.x, stands.y, 0);
    const [azimuth, height, times] = model.camera.length ? model.camera : FIRST_VIEW, far = this.distance() * times;
    camera.position.set(Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth), Math.sin(height)).multiplyScalar(far).add(seen);
    controls.minDistance = 1.6;
    this.fitBody();
    controls.maxPolarAngle = Math.PI / 2 - 0.02; // never from below the table
    controls.update();
  }

  // For a larger body, the camera looks at a higher point, and may be farther away.
  fitBody() {
    const { seen, camera, controls } = this, size = Math.max(1, this.reach() / USUAL), up = MIDDLE * size - seen.z;
    seen.z += up;
    camera.position.z += up;
    camera.far = 7 * FARTHEST * size;
    camera.updateProjectionMatrix();
    controls.maxDistance = FARTHEST * size;
    controls.target.copy(seen);
    camera.lookAt(seen);
  }

  // A person has turned or zoomed, or only clicked: stores the view relative to the point that the camera looks at.
  tell() {
    const { model } = this, { x, y, z } = this.camera.position.clone().sub(this.seen), far = Math.hypot(x, y, z);
    const view = [Math.atan2(y, x), Math.asin(z / far), far / this.distance()].map((value) => Number(value.toFixed(3)));
    if (String(view) !== String(model.camera.length ? model.camera : FIRST_VIEW)) model.camera = view;
  }

  // The window has a new shape. A person's zoom is kept: only what the shape takes away is given back.
  /** @param {number} aspect */
  fit(aspect) {
    if (this.aspect === undefined) this.begin();
    else this.zoom(Math.min(1, this.aspect) / Math.min(1, aspect));
    this.aspect = aspect;
  }

  zoom(times) {
    if (times !== 1) this.camera.position.sub(this.seen).multiplyScalar(times).add(this.seen);
  }
}
