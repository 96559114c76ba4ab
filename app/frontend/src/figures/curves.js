// Curves, as columns of numbers sent by Python, and positions on them. Nothing here knows about the page.

/** @param {number} value @param {number} least @param {number} most */
export const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

// A row and the fraction of the way to the next row, at a fraction of all rows.
/** @param {number} last its number @param {number} share @returns {Spot} */
function spotAt(last, share) {
  const at = clamp(share, 0, 1) * last, row = Math.min(Math.floor(at), last - 1);
  return [row, at - row];
}

// The position of a time in t, which is evenly spaced. Times before the start or after the end are moved there.
/** @param {Column} t @param {number} now */
export const spotOf = (t, now) => spotAt(t.length - 1, (now - t[0]) / (t[t.length - 1] - t[0]));

// The same on a curve that repeats.
/** @param {Column} t @param {number} now */
export function spotInTurn(t, now) {
  const last = t.length - 1, span = t[last] - t[0], since = now - t[0];
  return spotAt(last, (since <= span ? Math.max(since, 0) : since % span) / span);
}

/** @param {Column} values @param {Spot} spot */
export const valueAt = (values, [row, share]) => values[row] + share * (values[row + 1] - values[row]);

/** @param {Column} values @param {number} value */
export const nearestRow = (values, value) =>
  values.reduce((best, _, row) => (Math.abs(values[row] - value) < Math.abs(values[best] - value) ? row : best), 0);

// The time at which a motion is closest to a tilt; of several, the one closest to now.
/** @param {{ t: Column, theta: Column }} motion @param {number} aim @param {number} now */
export function timeAtTilt({ t, theta }, aim, now) {
  const last = t.length - 1;
  let found = now, least = Infinity;
  for (let i = 0; i < last; i++) {
    const [from, to] = [theta[i], theta[i + 1]], inside = clamp(aim, Math.min(from, to), Math.max(from, to));
    const at = t[i] + (from === to ? 0 : (inside - from) / (to - from)) * (t[i + 1] - t[i]);
    const away = 1e3 * Math.abs(inside - aim) + Math.abs(at - now) / (t[last] - t[0]);
    if (away < least) [found, least] = [at, away];
  }
  return found;
}

// The time of the point of a curve closest to the pointer; of several, the one closest to now. whole: the curve shows
// the whole motion; otherwise it repeats.
/** @param {{ t: Column, x: Column, y: Column }} curve @param {[x: number, y: number]} hand @param {{ x: PixelScale, y: PixelScale }} scales */
export function timeAtPoint({ t, x, y }, hand, now, whole, scales) {
  const span = t[t.length - 1] - t[0], px = scales.x.compute(hand[0]), py = scales.y.compute(hand[1]);
  let found = now, least = Infinity;
  for (let i = 0; i < t.length; i++) {
    const turns = Math.round((now - t[i]) / span), at = t[i] + (whole ? 0 : Math.max(turns, 0) * span);
    const away = Math.hypot(scales.x.compute(x[i]) - px, scales.y.compute(y[i]) - py) + Math.abs(at - now) / span;
    if (away < least) [found, least] = [at, away];
  }
  return found;
}
