// What the pointer grabs on Fig. 6. Dragging the bead moves the clock, in the browser alone; dragging an end of the
// selected tieline changes the energy, dragging the tieline itself changes K_J. Pressing on another tieline selects its
// motion, and beyond the tielines the motion that has its turning point there.
import { clamp } from "../figures/curves.js";
import { isOn, placeIn } from "./reading.js";

export const REACH = 14; // px
const LEAST = 5; // px

// The distance of a point on the screen from the selected tieline, in px.
/** @param {Tieline} shown @param {number} px @param {number} py @param {{ x: PixelScale, y: PixelScale }} scales */
export const awayFromTieline = ({ inner, outer, K_J }, px, py, { x, y }) =>
  Math.hypot(Math.max(x.compute(inner) - px, 0, px - x.compute(outer)), y.compute(K_J) - py);

// point: on the screen; hand: theta and K_J there, or where the pointer has moved since.
/**
 * @param {Tieline & { theta: number }} shown the selected motion, and where its bead is
 * @param {{ K_J: Column, slip_in: Column, slip_out: Column }} limits
 * @param {[px: number, py: number]} point
 * @param {[theta: number, K_J: number]} hand
 * @param {{ x: PixelScale, y: PixelScale }} scales
 * @returns {"bead" | "end" | "line" | "tieline" | "point"}
 */
export function gripAt(shown, limits, [px, py], [theta, K_J], { x, y }) {
  const away = (tilt) => Math.hypot(x.compute(tilt) - px, y.compute(shown.K_J) - py);
  const inner = x.compute(shown.inner), outer = x.compute(shown.outer);
  // on a short tieline, the bead and the ends leave room to grab the line itself
  const near = px > inner && px < outer ? clamp((outer - inner) / 4, LEAST, REACH) : REACH;
  if (away(shown.theta) < near) return "bead";
  if (Math.min(away(shown.inner), away(shown.outer)) < near) return "end";
  if (away(clamp(x.invert(px), shown.inner, shown.outer)) < REACH) return "line";
  return isOn(limits.slip_in, limits.slip_out, placeIn(limits.K_J, K_J), theta) ? "tieline" : "point";
}
