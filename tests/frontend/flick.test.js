// The directions of a flick, without a picture.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { pushesIn } from "../../app/frontend/src/lab/flick.js";
import { turnsOf } from "../../app/frontend/src/three/flick.js";
import { along, inSpace } from "../../app/frontend/src/three/impulse.js";

const z = new Vector3(0, 0, 1), near = (found, wanted) => found.forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) < 1e-12, `${found}`));

test("a vector is given along the axes that turn with the top", () => {
  const theta = 0.7, phi = 0.4, axis = new Vector3(Math.sin(phi) * Math.sin(theta), -Math.cos(phi) * Math.sin(theta), Math.cos(theta));
  const first = new Vector3(Math.cos(phi), Math.sin(phi), 0); // 1' of Euler's angles
  near(along(first, axis, z), [1, 0, 0]);
  near(along(z, axis, z), [0, 0, 1]);
  near(along(axis, axis, axis), [0, 0, 1]);
  near(along(z, axis, axis), [0, Math.sin(theta), Math.cos(theta)]); // 2' rises with the tilt
  for (const third of [z, axis]) near(inSpace(along(new Vector3(1, 2, 3), axis, third), axis, third).toArray(), [1, 2, 3]);
});

test("upright, 1' is x", () => near(along(new Vector3(1, 2, 3), z, z), [1, 2, 3]));

test("a flick the way that the point turns spins it that way, along its axis not at all", () => {
  const point = new Vector3(1, 0, 0.5), turns = (x, y, up) => turnsOf(new Vector3(x, y, up), z, point);
  assert.ok(turns(0, 1, 0) > 0 && turns(0, -1, 0) === -turns(0, 1, 0));
  assert.equal(turns(0, 0, 1), 0);
  assert.equal(turns(0, 2, 0), 2 * turns(0, 1, 0));
});

test("the pushes of a run are read in R and M (gR)^1/2, with their sizes", () => {
  const texts = { push_units: ["{size} mN s", "{size} N s"], decimal: "," };
  const [one, other] = pushesIn(texts, { R: 15, impulse: 2, of: { pushes: [".5_0_3_15_.6_-.8_0~2_0_0_0_0_0_3000"] } });
  assert.deepEqual([one.t, one.point, one.impulse, one.wording], [0.5, [0, 0.2, 1], [0.3, -0.4, 0], "1,00 mN s"]);
  assert.equal(other.wording, "3,00 N s");
  assert.deepEqual(pushesIn(texts, { R: 15, impulse: 2, of: { pushes: [""] } }), []);
});
