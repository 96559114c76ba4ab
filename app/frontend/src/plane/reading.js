// The limits of the motions that roll, as Python sent them, and what they say of a place.
import { valueAt } from "../figures/curves.js";
import { fill, float32, local, rowBefore } from "../data.js";

const NAMES = ["K_J", "lift_in", "slip_in", "slip_out", "lift_out", "verge", "lift_verge", "steady", "slip_E", "slip_by", "lift_by"];

// The columns by name; of those that say what limits a row, the words of `limitedBy`.
/** @param {Bytes} bytes @param {string[]} limitedBy @returns {Limits} */
export function limitsFrom(bytes, limitedBy) {
  const all = new Float64Array(bytes ? new Uint8Array(bytes).slice().buffer : new ArrayBuffer(0)), count = all.length / NAMES.length;
  const columns = Object.fromEntries(NAMES.map((name, i) => [name, all.subarray(i * count, (i + 1) * count)]));
  const words = (name) => Array.from(columns[name], (code) => limitedBy[code]);
  return /** @type {Limits} */ ({ ...columns, slip_by: words("slip_by"), lift_by: words("lift_by") });
}

// Where a K_J is among the rows: between which two, and which of them is nearer.
/** @param {Column} K_J @param {number} value @returns {RowPlace} */
export function placeIn(K_J, value) {
  const low = rowBefore(K_J, value), share = Math.min(Math.max((value - K_J[low]) / (K_J[low + 1] - K_J[low]), 0), 1);
  return { spot: [low, share], row: share < 0.5 ? low : low + 1 };
}

// A limit at a K_J, between two rows as it is drawn; beside a gap that of the nearer row, which has perhaps none.
/** @param {Column} values @param {RowPlace} place */
export function limitAt(values, { spot, row }) {
  const [low, share] = spot, between = share === 1 ? values[low + 1] : valueAt(values, spot);
  return Number.isFinite(between) ? between : values[row];
}

// Whether a tilt is between two limits; false where there are none.
/** @param {Column} inner @param {Column} outer @param {RowPlace} place @param {number} theta */
export const isOn = (inner, outer, place, theta) => theta >= limitAt(inner, place) && theta <= limitAt(outer, place);

// E and F_h/F_z at a place. field: [columns, least K_J, largest K_J]; the first row is the lowest.
/** @param {Bytes} bytes @param {[columns: number, low: number, high: number]} field @param {number} end of the theta axis @param {[theta: number, K_J: number]} place */
export function valuesIn(bytes, [columns, low, high], end, [theta, K_J]) {
  const both = float32(bytes), size = both.length / 2, rows = size / columns;
  const inside = (share, all) => Math.min(Math.max(Math.floor(share * all), 0), all - 1);
  const cell = inside((K_J - low) / (high - low), rows) * columns + inside(theta / end, columns);
  return { E: both[cell], ratio: both[size + cell] };
}

// What is at a place, which alone decides the verdict. Its numbers are those of the nearest tieline, which a press would
// select. E: the energy at the place from the field, whose numbers are rounded and whose cells are as wide as a degree.
/** @param {Limits} limits @param {Record<string, any>} words @param {Record<"x" | "y" | "E" | "ratio", number>} place */
export function readPlane({ K_J, slip_in, slip_out, lift_in, lift_out, slip_E, slip_by, lift_by }, words, { x, y, E, ratio }) {
  const place = placeIn(K_J, y), { row } = place, rolls = isOn(slip_in, slip_out, place, x);
  const limited = { slip: words.then_slip, "lift-off": words.then_lift, "no motion": words.steady_cannot, nothing: words.unlimited };
  const why = { slip: words.not_slip, "lift-off": words.not_lift };
  const limit = isOn(lift_in, lift_out, place, x) ? slip_by[row] : lift_by[row];
  const verdict = rolls || !(slip_by[row] in why) ? limited[slip_by[row]] : (why[limit] ?? words.not_at_all);
  const energy = rolls && Number.isFinite(slip_E[row]) ? slip_E[row] : E;
  return fill(words.place, {
    K_J: local(K_J[row].toFixed(3)), theta: local(x.toFixed(3)), degrees: local(((x * 180) / Math.PI).toFixed(1)), E: local(energy.toFixed(4)),
    ratio: Number.isFinite(ratio) ? local(ratio.toFixed(3)) : words.no_contact, verdict,
  });
}
