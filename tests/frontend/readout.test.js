import assert from "node:assert/strict";
import test from "node:test";
import { placeBeside } from "../../app/frontend/src/figures/readout.js";
import { limitAt, placeIn, readPlane, valuesIn } from "../../app/frontend/src/plane/reading.js";

const page = { wide: 390, high: 800 }, size = { wide: 180, high: 110 };

const covers = ({ left, top }, box) =>
  left < box.right && left + size.wide > box.left && top < box.bottom && top + size.high > box.top;

test("the box is in the window and covers nothing that must stay visible, wherever the pointer is", () => {
  const line = { left: 60, right: 140, top: 300, bottom: 330 };
  for (let x = 4; x < 390; x += 13) {
    for (let y = 4; y < 800; y += 13) {
      const place = placeBeside([x, y], size, page, [line]);
      assert.ok(place.left >= 0 && place.left + size.wide <= page.wide && place.top >= 0 && place.top + size.high <= page.high);
      assert.ok(!covers(place, line) && !covers(place, { left: x - 1, right: x + 1, top: y - 1, bottom: y + 1 }), `${x} ${y}`);
    }
  }
});

test("if there is room it is to the right of the pointer, at its height", () => {
  assert.deepEqual(placeBeside([500, 400], size, { wide: 1400, high: 900 }, []), { left: 514, top: 345 });
});

test("a place has the value of its cell, and beyond the picture that of the nearest cell", () => {
  const { buffer } = Float32Array.from({ length: 24 }, (_, i) => (i < 12 ? i : 100 + i - 12)), at = (place) => valuesIn(buffer, [4, -1, 2], 4, place);
  for (const [place, cell] of [[[0.5, -0.5], 0], [[3.5, 1.9], 11], [[2.5, 0.5], 6], [[9, -7], 3]]) assert.deepEqual(at(place), { E: cell, ratio: 100 + cell });
});

test("between two rows a limit is where it is drawn, and beside a gap that of the nearer row", () => {
  const K_J = [0, 1, 3, 4], limits = [NaN, 0.5, 0.9, 1], at = (value) => limitAt(limits, placeIn(K_J, value));
  assert.deepEqual([-1, 0.2, 0.8, 1, 2, 3, 3.5, 4, 9].map(at), [NaN, NaN, 0.5, 0.5, 0.7, 0.9, 0.95, 1, 1]);
});

test("the text for a place names the limit that it keeps or exceeds, whatever the rounded energy of the field", () => {
  const limits = /** @type {any} */ ({
    K_J: [0, 1], slip_in: [NaN, 0.3], slip_out: [NaN, 0.6], lift_in: [0, 0.1], lift_out: [3, 0.9], slip_E: [NaN, 3.1],
    slip_by: ["no motion", "slip"], lift_by: ["lift-off", "lift-off"],
  });
  const words = { place: "{K_J} {verdict} {E}", then_slip: "rolls", not_slip: "slips", not_lift: "lifts", steady_cannot: "never" };
  const read = (x, y = 1) => [3.0999, 3.1001].map((E) => readPlane(limits, words, { x, y, E, ratio: Infinity }).split(" ")[1]).join(" ");
  assert.deepEqual([0.05, 0.2, 0.301, 0.599, 0.7, 1].map((x) => read(x)), ["lifts lifts", "slips slips", "rolls rolls", "rolls rolls", "slips slips", "lifts lifts"]);
  assert.equal(read(0.5, 0.1), "never never");
  assert.equal(readPlane(limits, words, { x: 0.4, y: 1, E: Math.fround(3.1), ratio: 0 }), "1.000 rolls 3.1000");
});
