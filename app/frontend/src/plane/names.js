// Where the names of the curves of Fig. 6 may stand, in the order in which they are tried.
import { degrees, fill, local, tidy } from "../data.js";
import { touchBoxes } from "./drawing.js";
import { limitAt, placeIn } from "./reading.js";
/** @import { Plot } from "./scales.js" */
/** @import { Box } from "../data.js" @import { Name, Place } from "./words.js" */

const HEIGHTS = [0.12, 0.2, 0.06, 0.28, 0.38, 0.48, 0.58, 0.7, 0.8, 0.9]; // of the axis of K_J
const ALONG = [0.5, 0.35, 0.65, 0.2, 0.8, 0.95, 0.05]; // of the path of a motion that slips
const START = /** @type {const} */ ("start"), END = /** @type {const} */ ("end"), SIDES = /** @type {const} */ (["middle", "start", "end"]);
const AWAY = 10; // px from the region

// The region, row by row, that names keep clear of.
/** @param {Plot} plot @param {Limits} limits @returns {Box[]} */
export function regionBoxes({ x, y }, { K_J, lift_in, lift_out }) {
  return Array.from(K_J.subarray(0, -1), (_, i) => ({ left: x(lift_in[i]), right: x(lift_out[i]), top: y(K_J[i + 1]), bottom: y(K_J[i]) }))
    .filter(({ left, right }) => right > left);
}

// Beside the region, with a line to the curve where another one is nearer; or on it, with a halo.
/** @param {Plot} plot @param {Limits} limits @param {(place: RowPlace) => number} tilt @param {"start" | "end"} first @param {number} size @returns {Place[]} */
function beside({ x, y, box }, limits, tilt, first, size) {
  const rows = HEIGHTS.map((share) => box.bottom - share * (box.bottom - box.top)).map((py) => ({ py, place: placeIn(limits.K_J, y.invert(py)) }))
    .filter(({ place }) => Number.isFinite(tilt(place)));
  const edge = (py, column, most) => {
    const all = [-size, 0, size].map((by) => x(limitAt(column, placeIn(limits.K_J, y.invert(py + by))))).filter(Number.isFinite);
    return most(...all);
  };
  const on = (side) => rows.map(({ py, place }) => {
    const curve = x(tilt(place)), isRight = side === "start";
    const px = isRight ? edge(py, limits.lift_out, Math.max) + AWAY : edge(py, limits.lift_in, Math.min) - AWAY;
    const to = Math.abs(px - curve) > 2 * AWAY ? /** @type {[number, number]} */ ([curve, py]) : undefined;
    return { x: px, y: py + 0.35 * size, side, to };
  });
  const onIt = rows.map(({ py, place }) => ({ x: x(tilt(place)) + 6, y: py + 0.35 * size, side: /** @type {"start"} */ ("start") }));
  return /** @type {Place[]} */ ([...on(first), ...on(first === "start" ? "end" : "start"), ...onIt]);
}

/** @param {Plot} plot @param {Limits} limits @param {Record<string, any>} texts @param {number} mu_s @param {number} size @returns {Name[]} */
export function curveNames(plot, limits, texts, mu_s, size) {
  const of = (name) => (place) => limitAt(limits[name], place);
  const middle = (one, other) => (place) => (of(one)(place) + of(other)(place)) / 2;
  const lost = (place) => (plot.x(of("lift_out")(place)) - plot.x(of("slip_out")(place)) > 3 ? middle("slip_out", "lift_out")(place) : NaN);
  /** @type {[name: string, tilt: (place: any) => number, first: "start" | "end"][]} */
  const all = [["lift", of("lift_verge"), "start"], ["verge", of("verge"), "start"], ["steady", of("steady"), "end"], ["lost", lost, "start"], ["tielines", middle("slip_in", "slip_out"), "end"]];
  return all.map(([name, tilt, first]) => ({
    kind: name, places: beside(plot, limits, tilt, first, size),
    says: texts.names[name].map((text) => fill(text, { mu: tidy(mu_s) })),
  }));
}

// What a path must not be covered at: boxes along it.
/** @param {Plot} plot @param {Float32Array} theta @param {Float32Array} values @returns {Box[]} */
export const pathBoxes = ({ x, y }, theta, values) => Array.from(theta, (tilt, i) =>
  ({ left: x(tilt) - 4, right: x(tilt) + 4, top: y(values[i]) - 5, bottom: y(values[i]) + 5 }));

// Above or below a path, beginning or ending there.
/** @param {Plot} plot @param {Column} theta @param {Column} values @param {number} size @param {number[]} shares @param {number} lines of the text @returns {Place[]} */
function along({ x, y }, theta, values, size, shares, lines = 1) {
  return shares.flatMap((share) => {
    const i = Math.round(share * (theta.length - 1)), px = x(theta[i]), py = y(values[i]);
    return [py - (1.25 * lines - 0.25) * size, py + 1.8 * size].flatMap((base) =>
      SIDES.map((side) => ({ x: px, y: base, side })));
  });
}

/** @param {Record<"plane" | "routh", Plot>} plots @param {Path} path @param {Record<string, any>} state @param {Record<string, any>} texts @param {number} size @returns {Record<"first" | "last" | "routh", Name[]>} */
export function pathNames({ plane, routh }, path, state, texts, size) {
  const { theta, K_J } = path, { slips } = texts, last = theta.length - 1, at = (tilt) => ({ degrees: local(degrees(tilt).toFixed(0)) });
  const ends = along(plane, theta, K_J, size, [1, 0.9, 0.8]).sort((a, b) => b.y - a.y); // below the end if there is room
  const first = [{ kind: "K_J", says: slips.keeps, places: along(plane, theta, K_J, size, ALONG) }];
  if (state.rolls) first.unshift({ kind: "K_J", says: slips.ends.map((text) => fill(text, at(theta[last]))), places: ends });
  const touches = () => ({ kind: "", says: slips.touches.map((text) => fill(text, at(state.touch))), places: touchBoxes(plane, path, state).flatMap(({ top, bottom, left, right }) =>
    [0.5, 0.35, 0.2, 0.65, 0.8].flatMap((share) => [{ x: right + 4, side: START }, { x: left - 4, side: END }].map((side) => ({ ...side, y: top + share * (bottom - top) }))) ) });
  return { first, last: state.touches === null ? [] : [touches()], routh: routhNames(routh, path, slips, size) };
}

/** @param {Plot} plot @param {Path} path @param {Record<string, any>} slips @param {number} size @returns {Name[]} */
function routhNames(plot, { theta, K_R }, slips, size) {
  const { x, y, box } = plot, last = theta.length - 1, through = K_R[0] * K_R[last] < 0 ? slips.through : slips.changes;
  const inside = [0.9, 0.1].flatMap((share) => [0.12, 0.75, 0.4].map((down) =>
    ({ x: box.left + share * (box.right - box.left), y: box.top + down * (box.bottom - box.top) + size, side: share > 0.5 ? END : START })));
  const ends = [0.35, -0.5, 1.3].flatMap((down) => [{ by: 11, side: START }, { by: -11, side: END }].map(({ by, side }) => ({ x: x(theta[last]) + by, y: y(K_R[last]) + down * size, side })));
  return [
    { kind: "K_R", says: [local(K_R[last].toFixed(1))], places: ends },
    { kind: "K_R", says: through, places: [...along(plot, theta, K_R, size, [0.75, 0.6, 0.4, 0.25]), ...inside] },
    { kind: "", says: slips.nods, places: inside },
  ];
}

// Beside the selected tieline.
/** @param {Plot} plot @param {Tieline} shown @param {Name["says"]} says @param {number} size @returns {Name} */
export function tielineName({ x, y }, { inner, outer, K_J }, says, size) {
  const [left, right, level] = [x(inner), x(outer), y(K_J)], middle = (left + right) / 2;
  const to = (px) => /** @type {[number, number]} */ ([px, level]);
  return { kind: "chosen", says, places: [
    { x: right + 2 * size, y: level - 2 * size, side: "start", to: to(right - 3) }, { x: left - 2 * size, y: level - 2 * size, side: "end", to: to(left + 3) },
    { x: right + 2 * size, y: level + 2.6 * size, side: "start", to: to(right - 3) }, { x: left - 2 * size, y: level + 2.6 * size, side: "end", to: to(left + 3) },
    { x: middle, y: level - 1.2 * size, side: "middle" }, { x: middle, y: level + 2 * size, side: "middle" },
    { x: left, y: level - 1.2 * size, side: "start" }, { x: right, y: level - 1.2 * size, side: "end" }, { x: left, y: level + 2 * size, side: "start" },
  ] };
}
