import assert from "node:assert/strict";
import { test } from "node:test";
import { awayFromTieline, gripAt, REACH } from "../../app/frontend/src/plane/grips.js";
import { isFollowed } from "../../app/frontend/src/figures/seeking.js";
import { modelOf } from "../../app/frontend/src/stand_in.js";
import { inLook, stepOf } from "../../app/frontend/src/widgets/address.js";
import { figures, rowAt, wording } from "../../app/frontend/src/widgets/lines.js";
import { placeBeside } from "../../app/frontend/src/figures/readout.js";
import { markOf } from "../../app/frontend/src/widgets/phone.js";

// 100 px a radian, 10 px a unit of K_J
const scale = (px) => ({ compute: (value) => px * value, invert: (at) => at / px });
const scales = { x: scale(100), y: scale(10) };
const shown = { K_J: 10, inner: 1, outer: 3, theta: 2 };
const limits = { K_J: [0, 10, 20], slip_in: [0.5, 0.5, 0.5], slip_out: [1, 1, 4] };
const at = (theta, K_J) => gripAt(shown, limits, [100 * theta, 10 * K_J], [theta, K_J], scales);

test("on a short tieline there is room for bead, end and the line itself", () => {
  const short = { K_J: 10, inner: 1, outer: 1.34, theta: 1 };
  const taken = (theta) => gripAt(short, limits, [100 * theta, 100], [theta, 10], scales);
  assert.deepEqual([1, 1.07, 1.15, 1.22, 1.3, 1.34, 1.45].map(taken), ["bead", "bead", "line", "line", "end", "end", "end"]);
});

test("one can grab the bead, an end, the tieline, another tieline, or a point beyond", () => {
  assert.deepEqual([[2, 10], [2.13, 10], [1, 10], [3.1, 10.5], [1.5, 10], [1.5, 11], [0.7, 15.5], [2, 19], [5, 19]].map(([x, y]) => at(x, y)),
    ["bead", "bead", "end", "end", "line", "line", "tieline", "tieline", "point"]);
});

test("what was under the pointer when it was pressed stays grabbed", () => {
  assert.equal(gripAt(shown, limits, [100, 100], [2, 50], scales), "end");
});

test("the distance of the selected tieline is that of its nearest point", () => {
  const away = (px, py) => awayFromTieline(shown, px, py, scales);
  assert.deepEqual([away(200, 100), away(200, 113), away(97, 104), away(303, 96)], [0, 13, 5, 5]);
  assert.ok(REACH > 5);
});

test("a figure starts to follow the clock only once", () => {
  const [one, other] = [{}, {}];
  assert.deepEqual([isFollowed(one), isFollowed(one), isFollowed(other)], [false, true, false]);
});

test("the keys for undo and redo, on every system", () => {
  const key = (name, ...held) => stepOf(/** @type {any} */ ({ key: name, ...Object.fromEntries(held.map((each) => [`${each}Key`, true])) }));
  assert.deepEqual([key("z", "ctrl"), key("z", "meta"), key("Z", "ctrl", "shift"), key("y", "ctrl")], ["undone", "undone", "redone", "redone"]);
  assert.deepEqual([key("z"), key("z", "ctrl", "alt"), key("y", "ctrl", "shift"), key("x", "ctrl")], [null, null, null, null]);
});

test("a phone keeps its number, gets a new one for an invalid one, and has one even without storage", () => {
  const kept = new Map(), store = { getItem: (key) => kept.get(key) ?? null, setItem: (key, mark) => kept.set(key, mark) };
  const mark = markOf(store);
  assert.match(mark, /^[0-9a-f]{32}$/);
  assert.equal(markOf(store), mark);
  kept.set([...kept.keys()][0], "not one");
  assert.match(markOf(store), /^[0-9a-f]{32}$/);
  const none = () => { throw new Error("nothing may be kept"); };
  assert.match(markOf({ getItem: none, setItem: none }), /^[0-9a-f]{32}$/);
});

test("numbers of the derivation are short, and a vector has its brackets", () => {
  assert.deepEqual([1.23456789, -0.5, 0, 3e-301, 0.00001234, -2e-7].map((x) => figures(x, 6)), ["1.23457", "−0.5", "0", "0", "1.2e−5", "−2.0e−7"]);
  assert.equal(figures(0.00001234, 10), "1.234e−5");
  assert.equal(figures(NaN, 6), "—");
  assert.equal(wording(Float64Array.of(1, -2), 6), "(1; −2)");
});

test("the row of a time is the nearest one within its nutation", () => {
  const table = { values: Float64Array.of(0, 10, 1, 11, 2, 12), width: 2, period: 2 };
  assert.deepEqual([0, 0.4, 0.6, 1.9, 2.4, -0.9, 7].map((now) => rowAt(table, now)[1]), [10, 10, 11, 12, 10, 11, 11]);
});

test("the model of a letter calls its listeners when a value changes", () => {
  const model = modelOf({ time: 1 }), heard = [];
  model.on("time", () => heard.push(model.time));
  for (const time of [1, 2, 2, 3]) model.time = time;
  assert.deepEqual(heard, [2, 3]);
});

test("the words of the tour are beside their place if there is room, and always inside the window", () => {
  const page = { wide: 1000, high: 800 }, words = { wide: 300, high: 200 };
  const beside = (left, top, right, bottom) => placeBeside([(left + right) / 2, (top + bottom) / 2], words, page, [{ left, top, right, bottom }]);
  assert.equal(beside(0, 100, 400, 700).left, 414);
  assert.equal(beside(600, 100, 990, 700).left, 286);
  assert.equal(beside(10, 0, 990, 300).top, 314);
  assert.equal(beside(10, 500, 990, 790).top, 286);
  const { left, top } = beside(10, 10, 990, 790); // it fills the window
  assert.ok(left >= 0 && left + words.wide <= page.wide && top >= 0 && top + words.high <= page.high);
});

test("a link of the page keeps its language, its look and its frame, and nothing else of it", () => {
  const here = "?v=4&spin=9&lang=de&dark=yes&frame=1";
  assert.equal(inLook("?v=4&tab=learn", here), "?v=4&tab=learn&lang=de&dark=yes&frame=1");
  assert.equal(inLook("?v=4&tab=learn&lang=en", here), "?v=4&tab=learn&lang=en&dark=yes&frame=1");
  assert.equal(inLook("?v=4&body=Ball_.02_.04", ""), "?v=4&body=Ball_.02_.04");
});
