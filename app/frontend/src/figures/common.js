// Used by all figures. Their models are not synced, so playing sends nothing to the server.
import { elementOf, pressNever } from "../borrowed.js";
import { timeOf } from "../motion/clock.js";
import { followClock, isFollowed } from "./seeking.js";

// To a screen reader a canvas is an image with a name.
/** @param {{ fig: Figure, label: string }} given */
export function nameFigure({ fig, label }) {
  const el = elementOf(fig);
  if (!el) return;
  pressNever(fig);
  el.setAttribute("role", "img");
  el.setAttribute("aria-label", label);
  el.dataset.figure = fig.name;
}

// Lines at the time of the clock.
/** @param {{ spans: BokehModel[], clock?: string }} given */
export function moveLines({ spans, clock }) {
  if (isFollowed(spans[0])) return;
  const move = (t) => {
    for (const span of spans) span.setv({ location: t }, { sync: false });
  };
  followClock(move, clock);
  move(timeOf(clock));
}
