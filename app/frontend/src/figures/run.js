// A run: the top as a bead in its present well.
import { rowBefore } from "../data.js";
import { clamp, valueAt } from "./curves.js";
import { followClock, isFollowed } from "./seeking.js";

// The index of the well at a time, -1 for none, and the bead's theta, V and E there.
/** @param {Record<"t" | "theta" | "V" | "E" | "well", Column>} path @param {number} now */
export function beadAt({ t, theta, V, E, well }, now) {
  const last = t.length - 1, low = rowBefore(t, now), high = low + 1;
  /** @type {Spot} */
  const spot = [low, clamp((now - t[low]) / (t[high] - t[low]), 0, 1)];
  const which = now >= t[last] ? well[last] : well[low] === well[high] ? well[low] : -1;
  return { which, theta: valueAt(theta, spot), V: valueAt(V, spot), E: valueAt(E, spot) };
}

function showWell({ wells, steady, none, range }, which) {
  none.setv({ visible: which < 0 });
  const { alpha, low, high } = wells.data, { stable, well } = steady.data;
  wells.setv({ data: { ...wells.data, alpha: Array.from(alpha, (_, k) => (k === which ? 1 : 0)) } });
  const present = Array.from(well, (k) => (k === which ? 1 : 0));
  steady.setv({ data: { ...steady.data, alpha: present, fill: present.map((on, k) => on * stable[k]) } });
  if (which >= 0) range.setv({ start: low[which], end: high[which] });
}

/** @param {Record<"path" | "bead" | "wells" | "steady", Source> & Record<"none" | "range", BokehModel> & { clock: string }} given */
export function followWell(given) {
  const { path, bead, none, clock } = given;
  if (isFollowed(path)) return;
  let now = 0;
  /** @type {number | null} */
  let shown = null; // the index of a well
  const placeBead = () => {
    if (path.data.t.length < 2) return none.setv({ visible: false });
    const { which, theta, V, E } = beadAt(path.data, now);
    bead.setv({ data: which < 0 ? { theta: [], V: [], E: [] } : { theta: [theta], V: [V], E: [E] } });
    if (which !== shown) showWell(given, which);
    shown = which;
  };
  path.properties.data.change.connect(() => {
    shown = null;
    placeBead();
  });
  followClock(({ t }) => {
    now = t * path.tags[0];
    placeBead();
  }, clock);
}
