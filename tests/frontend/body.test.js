import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { Body } from "../../app/frontend/src/three/body.js";
import { near } from "./helping.js";

function bodyOf(profile) {
  const body = new Body();
  body.setProfile(new Float32Array(profile.flat()));
  const { position, normal } = body.geometry.attributes, index = body.geometry.index.array;
  const at = (i) => new Vector3().fromBufferAttribute(position, i);
  let volume = 0, area = 0;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => at(index[i + k]));
    volume += a.dot(b.clone().cross(c)) / 6;
    area += b.sub(a).cross(c.sub(a)).length() / 2;
  }
  return { body, position, normal, uv: body.geometry.attributes.uv, volume, area };
}
const sphere = Array.from({ length: 201 }, (_, i) => [Math.sin((i * Math.PI) / 200), -Math.cos((i * Math.PI) / 200)]);

test("a half circle makes a sphere, whether given upwards or downwards", () => {
  for (const profile of [sphere, sphere.toReversed()]) {
    const { body, position, normal, uv, volume, area } = bodyOf(profile);
    assert.equal(position.count, 201 * 57); // no edges
    near([volume, area], [(4 / 3) * Math.PI, 4 * Math.PI], 0.02); // 56 flat facets around it: 0.2 % less
    // At its poles, the direction of the piece there is used.
    const at = (attribute, i) => new Vector3().fromBufferAttribute(attribute, i).toArray();
    const isPole = (i) => Math.hypot(position.getX(i), position.getY(i)) < 1e-6;
    for (let i = 0; i < position.count; i++) near(at(normal, i), at(position, i), isPole(i) ? 0.01 : 1e-5);
    for (let i = 0; i < position.count; i++) { // painted by longitude and latitude
      if (isPole(i)) continue;
      const longitude = Math.atan2(position.getY(i), position.getX(i)) / (2 * Math.PI);
      near((uv.getX(i) - longitude + 0.5) % 1, 0.5, 1e-5);
      near(uv.getY(i), Math.acos(-position.getZ(i)) / Math.PI, 1e-5);
    }
    near([body.reach, body.top], [1, 1]);
  }
});

test("a cylinder has edges: its cap looks down or up and its side outwards", () => {
  const { body, normal, volume } = bodyOf([[0, -1], [2, -1], [2, 3], [0, 3]]);
  near(volume / (Math.PI * 4 * 4), 1, 0.003);
  for (let i = 0; i < normal.count; i++) {
    const z = normal.getZ(i);
    near(Math.hypot(normal.getX(i), normal.getY(i)) + Math.abs(z), 1);
    assert.ok([-1, 0, 1].includes(Math.round(1e6 * z) / 1e6));
  }
  near([body.reach, body.top], [Math.hypot(2, 3), 3]);
});
