import assert from "node:assert/strict";
import { test } from "node:test";
import { gripBetween } from "../../app/frontend/src/three/surface_hand.js";
import { Grid, SurfaceMesh } from "../../app/frontend/src/three/surface_mesh.js";
import { Scale } from "../../app/frontend/src/three/axes.js";
import { Eye } from "../../app/frontend/src/three/eye.js";
import { PerspectiveCamera, Raycaster, Vector3 } from "three";
import { near } from "./helping.js";

const grid = (heights) => new Grid({
  K_J: Float32Array.from([0, 1, 2]), theta: Float32Array.from([0, 1, 0, 1, 0, 1]), height: Float32Array.from(heights),
  energy: new Float32Array(3),
});

test("a surface has two triangles in each cell, and a gap where there is no motion", () => {
  const whole = new Uint32Array(12).fill(99), torn = new Uint32Array(12).fill(99);
  grid([0, 0, 1, 1, 2, 2]).fillTriangles(whole);
  assert.deepEqual([...whole], [0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5]);
  grid([0, 0, NaN, NaN, 2, 2]).fillTriangles(torn);
  assert.ok(torn.every((i) => i === 0));
});

test("a ray from above finds the nearest point of the surface", () => {
  const scales = { x: new Scale(0, 1), y: new Scale(0, 2), z: new Scale(0, 1) };
  scales.y.set(0, 2);
  const mesh = new SurfaceMesh(scales, []);
  mesh.show(grid([0, 0, 1, 1, 0, 0]));
  const from = (x, y) => new Raycaster(new Vector3(x, y, 9), new Vector3(0, 0, -1));
  mesh.object.updateMatrixWorld();
  assert.deepEqual([from(0.1, 0.9), from(0.9, 0.9), from(0.9, 1.8), from(5, 5)].map((ray) => mesh.nearest(ray)), [2, 3, 5, null]);
});

test("a place on the floor belongs to the tieline it is on, and elsewhere to none", () => {
  const one = grid([0, 0, 1, 1, 0, 0]);
  assert.deepEqual([[0.1, 0.9], [0.9, 0.4], [1, 1.8], [1.01, 1], [-0.1, 1]].map((/** @type {[number, number]} */ place) => one.on(place)), [2, 1, 5, null, null]);
  assert.equal(new Grid({ ...one, theta: new Float32Array(6).fill(NaN) }).on([0.5, 1]), null);
});

test("near an end the pointer grabs the end rather than the line, and far away neither", () => {
  assert.equal(gripBetween([10, 0], [200, 0]), "end");
  assert.equal(gripBetween([-90, 3], [110, 3]), "line");
  assert.equal(gripBetween([-90, 9], [110, 9]), null);
  assert.equal(gripBetween([30, 3], [230, 3]), null); // beyond the end
});

function eyeOf(view = []) {
  const camera = new PerspectiveCamera(30, 1), model = { camera: view, follow: true };
  camera.up.set(0, 0, 1);
  const controls = { target: new Vector3(), update: () => camera.lookAt(controls.target) };
  const stands = new Vector3(2, 3, 1), eye = new Eye(/** @type {any} */ ({ camera, controls }), /** @type {any} */ (model), stands, () => 2);
  eye.fit(1);
  return { eye, camera, model, stands };
}

test("the camera starts at the given position, and reports where it is", () => {
  const { eye, model } = eyeOf([0.5, 0.4, 1.2]);
  eye.tell();
  near(model.camera, [0.5, 0.4, 1.2], 2e-3);
});

test("the camera keeps its direction while it follows the top", () => {
  const { eye, stands } = eyeOf(), before = eye.direction;
  eye.follow(0, true);
  stands.set(4, 5, 1);
  for (let now = 0; now < 3000; now += 16) eye.follow(now, true);
  near([eye.seen.x, eye.seen.y], [4, 5], 1e-3);
  near(eye.direction, before);
});

test("a narrow window moves the camera away, and a wide one back", () => {
  const { eye, camera } = eyeOf(), away = () => camera.position.distanceTo(eye.seen), before = away();
  eye.fit(0.5);
  near(away(), 2 * before, 1e-9);
  eye.fit(1.6);
  near(away(), before, 1e-9);
});
