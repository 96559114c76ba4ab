// The pictures of a film's data: the line at the film's time, and a hand that pulls the moment at which a motion begins.
import { scalesOf, setCursor } from "../borrowed.js";
import { timeOf } from "../motion/clock.js";
import { followClock, isDown, isFollowed, seek } from "./seeking.js";

const CLOCK = "film";
const REACH = 16; // px: a hand so near to the line of the start takes that, else the time

// A figure's hand -> whether it has the start, and where each curve was before it was pulled.
/** @type {WeakMap<object, { first: number, curves: number[][] }>} */
const pulls = new WeakMap();

/** @param {{ spans: BokehModel[] }} given */
export function followFilm({ spans }) {
  if (isFollowed(spans[0])) return;
  const move = (t) => {
    for (const span of spans) span.setv({ location: t }, { sync: false });
  };
  followClock(move, CLOCK);
  move(timeOf(CLOCK));
}

/** @param {{ fig: any, hand: any, starts: any[], curves: any[] }} given @param {any} event */
export function pullFilm({ fig, hand, starts, curves }, event) {
  const { x, sx, event_name: name } = event, { start, end } = fig.x_range;
  const near = Math.abs(scalesOf(fig).x.compute(starts[0].location) - sx) < REACH;
  if (name === "mousemove") return setCursor(fig, near ? "ew-resize" : "pointer");
  if (name === "panstart" && near) {
    pulls.set(hand, { first: starts[0].location, curves: curves.map(({ data }) => Array.from(data.t)) });
  }
  const pull = pulls.get(hand);
  if (!pull) return seek(x, isDown(event), CLOCK);
  const at = Math.min(Math.max(x, start), end);
  for (const line of starts) line.setv({ location: at }, { sync: false });
  curves.forEach((source, i) => {
    pull.curves[i].forEach((t, row) => (source.data.t[row] = t + at - pull.first));
    source.change.emit();
  });
  if (name !== "panend") return;
  pulls.delete(hand);
  hand.data = { start: [at] };
}
