// The figures of a measured film: a handle for the moment at which a motion begins.
import { scalesOf, setCursor } from "../borrowed.js";
import { gestureOf, isDown, seek } from "./seeking.js";

const CLOCK = "film";
const REACH = 16; // px: a drag that starts this close to the line of the start moves the start, any other one the time

// For each hand that has grabbed the start: where the start and the curves were before.
/** @type {WeakMap<object, { first: number, curves: number[][] }>} */
const pulls = new WeakMap();

/** @param {{ fig: any, hand: any, starts: any[], curves: any[] }} given @param {Happened} event */
export function pullFilm({ fig, hand, starts, curves }, event) {
  const { x, sx } = event, name = gestureOf(event), { start, end } = fig.x_range;
  const near = Math.abs(scalesOf(fig).x.compute(starts[0].location) - sx) < REACH;
  if (name === "mousemove") return setCursor(fig, near ? "ew-resize" : "pointer");
  if (name === "panstart" && near) pulls.set(hand, { first: starts[0].location, curves: curves.map(({ data }) => Array.from(data.t)) });
  const pull = pulls.get(hand);
  if (!pull) return seek(x, isDown(event), CLOCK);
  const at = Math.min(Math.max(x, start), end);
  for (const line of starts) line.setv({ location: at });
  curves.forEach((source, i) => {
    pull.curves[i].forEach((t, row) => (source.data.t[row] = t + at - pull.first));
    source.change.emit();
  });
  if (name !== "panend") return;
  pulls.delete(hand);
  hand.data = { start: [at] };
}
