import assert from "node:assert/strict";
import { test } from "node:test";
import { coalesce, fill, float32, niceAbove } from "../../app/frontend/src/data.js";
import { near } from "./helping.js";

test("floats are read from a buffer, from a view, and from a view whose offset is not a multiple of four", () => {
  const values = [1.5, -2, 1e20], { buffer } = new Float32Array(values), bytes = new Uint8Array(buffer);
  for (const before of [0, 4, 3]) {
    const room = new Uint8Array(before + bytes.length + 5);
    room.set(bytes, before);
    assert.deepEqual(float32(room.subarray(before, before + bytes.length)), new Float32Array(values));
  }
  assert.deepEqual(float32(buffer), new Float32Array(values));
  for (const nothing of [null, undefined, new ArrayBuffer(0)]) assert.equal(float32(nothing).length, 0);
});

test("a scale ends at the next larger round number", () => {
  const known = [[1, 1], [1.01, 1.5], [1.5, 1.5], [2.2, 3], [6.5, 8], [8.1, 10], [10, 10], [0.0123, 0.015], [999, 1000], [1000, 1000], [4.2e7, 5e7]];
  for (const [x, nice] of known) near(niceAbove(x) / nice, 1, 1e-12);
  for (const none of [0, -3, NaN, Infinity]) assert.equal(niceAbove(none), 1);
});

test("numbers are put into a text", () => {
  assert.equal(fill("{a} and {b}, {a}", { a: 1, b: "two" }), "1 and two, 1");
});

test("several calls before a frame run once in it", () => {
  const frames = new Map();
  let ids = 0, runs = 0;
  globalThis.requestAnimationFrame = (run) => frames.set((ids += 1), run) && ids;
  globalThis.cancelAnimationFrame = (id) => frames.delete(id);
  const screen = () => {
    const due = [...frames.values()];
    frames.clear();
    for (const run of due) run();
  };
  const later = coalesce(() => (runs += 1));
  later();
  later();
  assert.equal(runs, 0);
  screen();
  assert.equal(runs, 1);
  later();
  later.cancel();
  screen();
  assert.equal(runs, 1);
  later();
  screen();
  assert.equal(runs, 2);
});
