import assert from "node:assert/strict";
import test from "node:test";
import { placeNames, scalesOf, silhouette } from "../../app/frontend/src/widgets/tops_map.js";

const size = { wide: 800, high: 600, type: 1 };

test("positions on the map and values convert into each other", () => {
  const { x, y, a, ratio, split } = scalesOf(size);
  for (const each of [-0.02, 0, 0.2, 0.4]) assert.ok(Math.abs(a(x(each)) - each) < 1e-9);
  for (const each of [0.4, 1, 1.4]) assert.ok(Math.abs(ratio(y(each)) - each) < 1e-9);
  assert.ok(x(-10) < x(-3) && x(-3) < split && split < x(0) && a(0) === -0.03 && ratio(-50) === 1.4);
});

test("a silhouette has both sides of its outline, and the size of all silhouettes", () => {
  const numbers = silhouette([[0, -1], [1, 0], [0, 1]]).match(/-?[\d.]+/g).map(Number);
  assert.equal(Math.max(...numbers), 18);
  assert.equal(Math.min(...numbers), -18);
  assert.equal(numbers.length, 12);
});

for (const type of [1, 1.35]) test(`names beside their silhouettes do not run over one another, ${type} times as large`, () => {
  const tops = [[300, 300], [330, 310], [350, 300], [790, 100], [60, 500]].map(([x, y]) => ({ x, y, words: "A wooden cone" }));
  const boxes = placeNames(tops, { ...size, type }).map(({ dx, dy }, k) => ({ x: tops[k].x + dx, y: tops[k].y + dy }));
  for (const [k, box] of boxes.entries()) {
    assert.ok(box.x > 40 && box.x < size.wide);
    for (const other of boxes.slice(0, k)) assert.ok(Math.abs(box.x - other.x) >= 13 * 7.2 * type - 1e-9 || Math.abs(box.y - other.y) >= 15 * type - 1e-9);
  }
});
