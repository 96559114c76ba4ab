// Where the two plots are: the plane, and below it K_R over the same tilts.

/** @typedef {PixelScale & ((value: number) => number)} Axle */
/** @import { Box } from "../data.js" */
/** @typedef {{ x: Axle, y: Axle, box: Box }} Plot */

// A linear scale from values to px.
/** @param {[number, number]} values @param {[number, number]} px @returns {Axle} */
export function scale([low, high], [from, to]) {
  const each = (to - from) / (high - low || 1), compute = (value) => from + (value - low) * each;
  return Object.assign(compute, { compute, invert: (at) => low + (at - from) / each });
}

/** @param {Box} box @param {[number, number]} across @param {[number, number]} up @returns {Plot} */
export const plotOf = (box, across, up) =>
  ({ box, x: scale(across, [box.left, box.right]), y: scale(up, [box.bottom, box.top]) });

// The boxes in a drawing of this size; size: of the type.
/** @param {number} width @param {number} height @param {number} size */
export function boxesOf(width, height, size) {
  const left = 3.4 * size, right = width - 1.2 * size, foot = height - 2.9 * size;
  const low = Math.min(Math.max(0.2 * height, 48), 110), bottom = foot - low - 1.5 * size;
  return { plane: { left, right, top: 2 * size, bottom }, routh: { left, right, top: foot - low, bottom: foot } };
}

// The range of a plot with room at its ends.
/** @param {number} low @param {number} high */
export function padded(low, high) {
  const pad = 0.12 * (high - low) || 1;
  return /** @type {[number, number]} */ ([low - pad, high + pad]);
}
