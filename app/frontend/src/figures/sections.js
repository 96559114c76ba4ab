// Sections through a top: in the lesson one that turns with the clock, and that of the body which is built. Not synced.
import { eventsOf, scalesOf } from "../borrowed.js";
import { clamp } from "./curves.js";
import { followClock, isFollowed } from "./seeking.js";

const ALONG = 1.9; // of the axis 3, beyond O, in R

// The paper's Fig. 4 at an instant, of points that Python sent: the outline, six lines and four points.
/** @typedef {[number, number]} Point */
/** @param {{ axis: Point, G: Point, foot: Point }} pose @param {{ across: Column, along: Column }} outline */
export function sectionAt({ axis, G, foot }, { across, along }) {
  const [e, f] = axis, tip = [ALONG * e, 1 + ALONG * f];
  const x = Array.from(across, (_, k) => across[k] * f + along[k] * e);
  const y = Array.from(across, (_, k) => 1 - across[k] * e + along[k] * f);
  // the axis 3; the verticals through G and C; r from C to G; the arm of the torque about z, above the points, which are
  // larger than it; that about 3
  const lines = [
    [-1.25 * e, 1 - 1.25 * f, ...tip], [G[0], 0, G[0], 1.7], [0, 0, ...G], [0, 1.5, G[0], 1.5], [0, 0, ...foot],
    [0, 0, 0, 1.7],
  ];
  return { x, y, lines, points: [[0, 1], G, [0, 0], tip] };
}

export function turnSection({ motion, body, lines, points, clock }) {
  if (isFollowed(motion)) return;
  let now = 0;
  const draw = () => {
    const { t, push } = motion.data, last = t.length - 1;
    const i = Math.round(clamp((now - t[0]) / (t[last] - t[0]), 0, 1) * last);
    const at = (name) => /** @type {Point} */ ([motion.data[`${name}_x`][i], motion.data[`${name}_y`][i]]);
    const drawn = sectionAt({ axis: at("axis"), G: at("G"), foot: at("foot") }, body.data);
    for (let k = 0; k < drawn.x.length; k++) [body.data.x[k], body.data.y[k]] = [drawn.x[k], drawn.y[k]];
    body.change.emit();
    drawn.lines.forEach((ends, k) => ["x0", "y0", "x1", "y1"].forEach((name, j) => (lines.data[name][k] = ends[j])));
    lines.change.emit();
    drawn.points.forEach(([x, y], k) => ([points.data.x[k], points.data.y[k]] = [x, y]));
    points.data.name[4] = push[i] >= 0 ? "F⊙" : "F⊗";
    [points.data.x[4], points.data.y[4]] = [0, -0.02];
    points.change.emit();
  };
  motion.properties.data.change.connect(draw);
  followClock((t) => {
    now = t;
    draw();
  }, clock);
  draw();
}

// Where a hand goes down: a quick one is elsewhere by the time it counts as dragging.
export function pressSection({ fig, pressed }) {
  if (isFollowed(pressed)) return;
  const press = ({ offsetX, offsetY }) => {
    const { x, y } = scalesOf(fig);
    pressed.data = { x: [x.invert(offsetX)], z: [y.invert(offsetY)] };
  };
  eventsOf(fig).addEventListener("pointerdown", press, { capture: true });
}
