// A map: a hand near the bead takes hold of it, a click goes to the cell; `hand` takes both to Python.
import { eventsOf, scalesOf } from "../borrowed.js";
import { clamp } from "./curves.js";
import { isFollowed } from "./seeking.js";

const REACH = 40; // px
const WAIT = 80; // ms between two places that are sent while a hand moves

// hand -> whether it holds the bead, and when a place was sent last.
/** @type {WeakMap<object, { held: boolean, sent: number }>} */
const hands = new WeakMap();

// How far the bead is from a place, in px.
/** @param {Pick<Source<"x" | "y">, "data">} bead @param {number[]} place @param {Record<"x" | "y", Pick<PixelScale, "compute">>} scales */
export function awayFromBead({ data }, [px, py], { x, y }) {
  return Math.hypot(x.compute(data.x[0]) - px, y.compute(data.y[0]) - py);
}

/** @param {{ fig: Figure, hand: Source, bead: Source<"x" | "y"> }} given @param {Happened} event */
export function pullBead({ fig, hand, bead }, { event_name: name, sx, sy, x, y }) {
  const own = hands.get(hand) ?? { held: false, sent: 0 }, clicked = name === "tap";
  hands.set(hand, own);
  if (name === "panstart") own.held = awayFromBead(bead, [sx, sy], scalesOf(fig)) < REACH;
  if (!clicked && !own.held) return;
  const { x_range: across, y_range: up } = fig;
  const place = { x: [clamp(x, across.start, across.end)], y: [clamp(y, up.start, up.end)] };
  bead.setv({ data: place }, { sync: false });
  const done = clicked || name === "panend", now = performance.now();
  if (done) own.held = false;
  if (!done && now - own.sent < WAIT) return;
  own.sent = now;
  hand.data = { ...place, cell: [clicked] };
}

// A finger near the bead moves it, and scrolls the page from everywhere else.
/** @param {{ fig: Figure, bead: Source<"x" | "y"> }} given */
export function keepFinger({ fig, bead }) {
  if (isFollowed(bead)) return;
  const events = eventsOf(fig);
  const onTouch = (event) => {
    const { left, top } = events.getBoundingClientRect(), [{ clientX, clientY }] = event.touches;
    const near = awayFromBead(bead, [clientX - left, clientY - top], scalesOf(fig)) < REACH;
    if (event.touches.length === 1 && near) event.preventDefault();
  };
  events.addEventListener("touchstart", onTouch, { passive: false });
}
