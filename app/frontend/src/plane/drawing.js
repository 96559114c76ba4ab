// What stands still in Fig. 6 while a motion is pulled: the axes, the region of the motions that roll, and its limits.
import { tidy } from "../data.js";
import { ticks } from "../motion/curves.js";
import { levels, marks } from "../figures/line.js";
import { drawn } from "../parts.js";
/** @import { Box } from "../data.js" @import { Plot } from "./scales.js" */

const CLOSE = 4; // px: tielines are no closer

/** @param {number} value */
export const shortly = (value) => tidy(value, 6);

const at = (x, y) => `${x.toFixed(1)} ${y.toFixed(1)}`;

// A line through the rows, with gaps where a row has no value.
/** @param {Plot} plot @param {Column} theta @param {Column} values */
export function lineOf({ x, y }, theta, values) {
  let pen = "M", d = "";
  for (let i = 0; i < values.length; i++) {
    if (Number.isFinite(theta[i])) d += `${pen}${at(x(theta[i]), y(values[i]))}`;
    pen = Number.isFinite(theta[i]) ? "L" : "M";
  }
  return d;
}

// The area between two limits, in one piece for each run of rows that have both.
/** @param {Plot} plot @param {Column} inner @param {Column} outer @param {Column} values */
export function areaOf({ x, y }, inner, outer, values) {
  let d = "", from = 0;
  for (let i = 0; i <= values.length; i++) {
    if (i < values.length && Number.isFinite(inner[i]) && Number.isFinite(outer[i])) continue;
    const rows = Array.from({ length: i - from }, (_, k) => from + k);
    if (rows.length > 1) {
      const there = rows.map((row) => at(x(inner[row]), y(values[row]))), back = rows.reverse().map((row) => at(x(outer[row]), y(values[row])));
      d += `M${[...there, ...back].join("L")}Z`;
    }
    from = i + 1;
  }
  return d;
}

// The region and its limits, without axes.
/** @param {Plot} plot @param {Limits} limits */
export function region(plot, { K_J, lift_in, slip_in, slip_out, lift_out, verge, lift_verge, steady }) {
  const { x, y } = plot;
  let tielines = "", last = Infinity;
  for (let i = 0; i < K_J.length; i++) {
    if (!Number.isFinite(slip_in[i]) || last - y(K_J[i]) < CLOSE) continue;
    last = y(K_J[i]);
    tielines += `M${at(x(slip_in[i]), last)}H${x(slip_out[i]).toFixed(1)}`;
  }
  return [
    drawn("path", { class: "lost", d: areaOf(plot, lift_in, slip_in, K_J) + areaOf(plot, slip_out, lift_out, K_J) }),
    drawn("path", { class: "tielines", d: tielines }), drawn("path", { class: "edge", d: lineOf(plot, lift_in, K_J) }),
    drawn("path", { class: "force", d: lineOf(plot, lift_verge, K_J) }), drawn("path", { class: "verge", d: lineOf(plot, verge, K_J) }),
    drawn("path", { class: "steady", d: lineOf(plot, steady, K_J) }),
  ];
}

// Marks of a vertical axis with their numbers, and lines across.
/** @param {Plot} plot @param {[number, number]} range @param {number} count @param {number} size of the type @param {(value: number) => string} word */
export const upwards = ({ y, box }, range, count, size, word) => levels(ticks(...range, count), { ...box, y }, word, 0, 0.35 * size);

/** @param {Plot} plot @param {[number, number]} range @param {number} count @param {number} size @param {(value: number) => string} word */
export const across = ({ x, box }, range, count, size, word) => marks(ticks(...range, count), { ...box, x }, word, 1.3 * size);

// The path of a motion that slips, above or below: its means, and the tilts that it nods through. touches: the row from
// which on it is that of a whole sphere.
/** @param {Plot} plot @param {Path} path @param {"K_J" | "K_R"} row @param {number | null} touches */
export function slipping(plot, path, row, touches) {
  const { theta, low, high, [row]: values } = path, { x, y } = plot, last = theta.length - 1;
  const until = (touches ?? last) + 1, part = (column, from, to) => column.subarray(from, to);
  const pieces = [["own", 0, until], ["beyond", until - 1, last + 1]].flatMap(([kind, from, to]) => [
    drawn("path", { class: `nods ${kind}`, d: areaOf(plot, part(low, from, to), part(high, from, to), part(values, from, to)) }),
    drawn("path", { class: `goes ${kind}`, d: lineOf(plot, part(theta, from, to), part(values, from, to)) }),
  ]);
  const ends = [x(theta[last]), y(values[last])], on = theta[last] >= theta[0] ? -1 : 1;
  return drawn("g", { class: row }, ...pieces,
    drawn("path", { class: "head", d: `M${at(ends[0] + 7 * on, ends[1])}l${9 * on} -5v10z` }),
    drawn("circle", { class: "last", cx: ends[0], cy: ends[1], r: 5 }));
}

// Where the stem touches the table: from the path to where the names of the curves are.
/** @param {Plot} plot @param {Path} path @param {Record<string, any>} state @returns {Box[]} */
export function touchBoxes({ x, y, box }, { K_J }, { touch, touches }) {
  if (touches === null) return [];
  const level = y(K_J[touches]), px = x(touch), high = 0.28 * (box.bottom - box.top), isHigh = level < (box.top + box.bottom) / 2;
  return [{ left: px - 2, right: px + 2, top: isHigh ? level : box.top + high, bottom: isHigh ? box.bottom - high : level }];
}

/** @param {Plot} plot @param {Path} path @param {Record<string, any>} state */
export const touchLine = (plot, path, state) => touchBoxes(plot, path, state).map(({ left, top, bottom }) =>
  drawn("line", { class: "touch", x1: left + 2, x2: left + 2, y1: top, y2: bottom }));
