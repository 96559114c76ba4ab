// One nutation, the track, the force: a bead on a curve at the time of the clock, which can be dragged.
import { elementOf, scalesOf } from "../borrowed.js";
import { timeOf } from "../motion/clock.js";
import { spotInTurn, timeAtPoint, valueAt } from "./curves.js";
import { LAB, followClock, isDown, isFollowed, seek } from "./seeking.js";

/** @param {{ fig: Figure, curve: Source<"t" | "x" | "y">, bead: Source<"x" | "y"> }} given */
export function followCurve({ curve, bead, fig }) {
  if (isFollowed(curve)) return;
  let now = timeOf(LAB);
  const place = () => {
    const { t, x, y } = curve.data;
    if (!(t[t.length - 1] > t[0])) return;
    const spot = spotInTurn(t, now);
    bead.data.x[0] = valueAt(x, spot);
    bead.data.y[0] = valueAt(y, spot);
    bead.change.emit();
  };
  curve.properties.data.change.connect(place);
  followClock(({ t }) => {
    now = t;
    if (elementOf(fig)?.offsetParent) place();
  }, LAB);
  place();
}

/** @param {{ fig: Figure, curve: Source<"t" | "x" | "y">, whole: boolean }} given @param {Happened} event */
export function seekOnCurve({ curve, fig, whole }, event) {
  const t = timeAtPoint(curve.data, [event.x, event.y], timeOf(LAB), whole, scalesOf(fig));
  seek(t, isDown(event));
}
