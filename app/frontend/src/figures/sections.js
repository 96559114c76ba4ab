// Sections through a top: in the lesson one that turns with the clock, and that of the body which is built. Not synced.
import { eventsOf, scalesOf } from "../borrowed.js";
import { clamp } from "./curves.js";
import { followClock, isFollowed } from "./seeking.js";

const ALONG = 1.9; // of the axis 3, beyond O, in R

// The paper's Fig. 4 at a tilt, of points that Python sent: the outline, six lines and four points.
/** @param {number} theta @param {number} a @param {{ across: Column, along: Column }} outline */
export function sectionAt(theta, a, { across, along }) {
  const s = Math.sin(theta), c = Math.cos(theta);
  const x = Array.from(across, (_, k) => across[k] * c - along[k] * s);
  const y = Array.from(across, (_, k) => 1 + across[k] * s + along[k] * c);
  const G = [a * s, 1 - a * c], tip = [-ALONG * s, 1 + ALONG * c];
  // the axis 3; the verticals through G and C; r from C to G; the arm of the torque about z, above the points, which are
  // larger than it; that about 3
  const lines = [
    [1.25 * s, 1 - 1.25 * c, ...tip], [G[0], 0, G[0], 1.7], [0, 0, ...G], [0, 1.5, G[0], 1.5], [0, 0, s * c, 1 - c * c],
    [0, 0, 0, 1.7],
  ];
  return { x, y, lines, points: [[0, 1], G, [0, 0], tip] };
}

export function turnSection({ motion, body, lines, points, clock }) {
  if (isFollowed(motion)) return;
  let now = 0;
  const draw = () => {
    const { t, theta, push, a } = motion.data, last = t.length - 1;
    const i = Math.round(clamp((now - t[0]) / (t[last] - t[0]), 0, 1) * last);
    const drawn = sectionAt(theta[i], a[0], body.data);
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
