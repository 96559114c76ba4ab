import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { Arrow } from "../../app/frontend/src/three/arrow.js";
import { WideLine } from "../../app/frontend/src/three/lines.js";
import { Ribbon, Thread } from "../../app/frontend/src/three/ribbon.js";
import { near } from "./helping.js";

const points = [[0, 0, 0], [1, 2, 3], [4, 4, 4], [-1, 0.5, 8]];
const put = (path) => (i, each) => each(...path[i]);
const ends = ({ geometry: { attributes } }, count) => ["instanceStart", "instanceEnd"].map((name) =>
  Array.from({ length: count }, (_, i) => ["getX", "getY", "getZ"].map((of) => attributes[name][of](i))));

test("a wide line through points equals the one that three.js makes", () => {
  const line = new WideLine({}), theirs = new LineGeometry().setPositions(points.flat());
  line.setPath(4, put(points));
  assert.equal(line.geometry.instanceCount, 3);
  assert.deepEqual(ends(line, 3), ends({ geometry: theirs }, 3));
});

test("a shorter path keeps the buffer, a longer one gets a new one, an empty one is not drawn", () => {
  const line = new WideLine({});
  line.setPath(4, put(points));
  const { geometry } = line;
  line.setPath(2, put(points.slice(2)));
  assert.ok(line.geometry === geometry && line.visible && geometry.instanceCount === 1);
  assert.deepEqual(ends(line, 1), [[points[2]], [points[3]]]);
  line.setPath(1, put(points));
  assert.equal(line.visible, false);
  line.setSegments(4, (i, each) => [0, 1].forEach((end) => each(i, end, 0)));
  assert.ok(line.geometry !== geometry && line.visible);
  assert.deepEqual(ends(line, 4)[1][3], [3, 1, 0]);
});

test("a thread has the given points, and a first part of them can be drawn", () => {
  const thread = new Thread({});
  thread.setPath(4, put(points));
  assert.deepEqual([...thread.geometry.attributes.position.array], points.flat());
  assert.ok(thread.visible && thread.geometry.attributes.position.version > 0);
  thread.points = 2;
  assert.deepEqual({ ...thread.geometry.drawRange }, { start: 0, count: 2 });
  thread.points = 1;
  assert.equal(thread.visible, false);
});

test("seen from above, a ribbon along a circle is a ring", () => {
  const N = 400, ribbon = new Ribbon(0.2, {});
  const turn = (i) => (2 * Math.PI * i) / (N - 1);
  ribbon.setPath(N, (i) => [3 * Math.cos(turn(i)), 3 * Math.sin(turn(i))], 0.5);
  const { attributes: { position }, index, drawRange } = ribbon.geometry;
  let area = 0;
  for (let i = 0; i < drawRange.count; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromBufferAttribute(position, index.getX(i + k)));
    area += b.sub(a).cross(c.sub(a)).z / 2;
  }
  near(Math.abs(area), Math.PI * (3.1 ** 2 - 2.9 ** 2), 1e-3);
  for (let i = 2; i < 2 * N - 2; i++) near(Math.hypot(position.getX(i), position.getY(i)), i % 2 ? 2.9 : 3.1);
  assert.ok(ribbon.visible && drawRange.start === 0 && position.version > 0);
  assert.ok(position.array.every((value, i) => i % 3 < 2 || value === 0.5));
});

test("an arrow ends where its vector ends, and is not drawn if it is too short", () => {
  const arrow = new Arrow(0), tip = new Vector3(), from = new Vector3(1, 2, 3);
  for (const [x, y, z] of [[0, 0, 2], [1, -2, 0.5], [0, 0, -1], [0.01, 0, 0]]) {
    arrow.point(from, x, y, z, tip);
    near(tip.toArray(), [1 + x, 2 + y, 3 + z]);
    arrow.updateMatrixWorld();
    for (const { shaft, head } of arrow.parts) {
      near(shaft.localToWorld(new Vector3(0, 0, 0)).toArray(), [1, 2, 3]);
      near(shaft.localToWorld(new Vector3(0, 0, 1)).distanceTo(head.getWorldPosition(new Vector3())), 0);
      near(head.localToWorld(new Vector3(0, 0, 1)).toArray(), tip.toArray());
      for (const { geometry } of [shaft, head]) {
        geometry.computeBoundingBox();
        near([geometry.boundingBox.min, geometry.boundingBox.max].flatMap((corner) => corner.toArray()), [-1, -1, 0, 1, 1, 1]);
      }
      assert.ok(head.scale.x > shaft.scale.x || head.scale.z < shaft.scale.x); // the head is wider, unless the arrow is too short
      assert.ok(head.scale.z <= 0.5 * Math.hypot(x, y, z) + 1e-9);
    }
  }
  arrow.point(from, 0, 0, 1e-4, tip);
  assert.equal(arrow.drawable, false);
});
