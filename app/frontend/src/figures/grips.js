// What a hand on Fig. 6 takes hold of. The bead moves the clock, all in the browser; an end of the tieline on display is the
// energy, the tieline itself K_J; any other tieline becomes the motion, and beyond the tielines the motion that turns there.
import { clamp, nearestRow } from "./curves.js";

export const REACH = 14; // px
const LEAST = 5; // px

// How far a point of the screen is from the tieline on display, in px.
/** @param {Tieline} shown @param {number} px @param {number} py @param {{ x: PixelScale, y: PixelScale }} scales */
export function awayFromTieline({ inner, outer, K_J }, px, py, { x, y }) {
  return Math.hypot(Math.max(x.compute(inner) - px, 0, px - x.compute(outer)), y.compute(K_J) - py);
}

// point: on the screen; hand: theta and K_J there, or where it went to meanwhile.
/**
 * @param {Tieline & { theta: number }} shown the motion on display, and where its bead is
 * @param {{ K_J: Column, slip_in: Column, slip_out: Column }} limits
 * @param {[px: number, py: number]} point
 * @param {[theta: number, K_J: number]} hand
 * @param {{ x: PixelScale, y: PixelScale }} scales
 * @returns {"bead" | "end" | "line" | "tieline" | "point"}
 */
export function gripAt(shown, limits, [px, py], [theta, K_J], { x, y }) {
  const away = (tilt) => Math.hypot(x.compute(tilt) - px, y.compute(shown.K_J) - py);
  const inner = x.compute(shown.inner), outer = x.compute(shown.outer);
  // on a short tieline bead and ends leave room for the line itself
  const near = px > inner && px < outer ? clamp((outer - inner) / 4, LEAST, REACH) : REACH;
  if (away(shown.theta) < near) return "bead";
  if (Math.min(away(shown.inner), away(shown.outer)) < near) return "end";
  if (away(clamp(x.invert(px), shown.inner, shown.outer)) < REACH) return "line";
  const row = nearestRow(limits.K_J, K_J);
  return theta >= limits.slip_in[row] && theta <= limits.slip_out[row] ? "tieline" : "point";
}
