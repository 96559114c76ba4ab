// Used by all figures.
import { elementOf, pressNever } from "../borrowed.js";
import { timeOf } from "../motion/clock.js";
import { dress } from "../parts.js";
import { followClock, isFollowed, LAB } from "./seeking.js";

// To a screen reader a canvas is an image with a name.
/** @param {{ fig: Figure, label: string }} given */
export function nameFigure({ fig, label }) {
  const el = elementOf(fig);
  if (!el) return;
  pressNever(fig);
  dress(el, { role: "img", "aria-label": label, "data-figure": fig.name });
}

// Lines at the time of the clock. path: its tags have the unit of time; range: the time axis, which turns a page where
// they leave it.
/** @param {{ spans: BokehModel[], clock?: string, path?: Source, range?: BokehModel & { start: number, end: number } }} given */
export function moveLines({ spans, clock = LAB, path, range }) {
  if (isFollowed(spans[0])) return;
  const move = ({ t }) => {
    const now = t * (path?.tags[0] ?? 1);
    for (const span of spans) span.setv({ location: now });
    if (!range) return;
    const { start, end } = range, page = end - start, turned = page * Math.floor(now / page);
    if (now < start || now > end) range.setv({ start: turned, end: turned + page });
  };
  followClock(move, clock);
  move({ t: timeOf(clock) });
}
