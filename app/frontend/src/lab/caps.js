// The ball's surface as a map of two caps, seen from below and from the stem; away from the middle the tilt at which a
// point touches the table. On it the trace of the contact.
import { drawn, dress, say } from "../parts.js";
import { passedBy, traceOf } from "../motion/trace.js";
import { Frames } from "../motion/frames.js";

const RINGS = [30, 60, 90]; // degrees from the middle of a cap
const ROOM = 20; // px below a cap, for its name

// Where a mark is on the map, in radii of a cap: the cap, 0 or 1, and x and y from its middle.
/** @param {{ x: number, y: number, z: number }} mark @returns {[cap: number, x: number, y: number]} */
export function onCap({ x, y, z }) {
  const upper = z > 0, out = Math.hypot(x, y), away = Math.atan2(out, Math.abs(z)) / (Math.PI / 2) / (out || 1);
  return [Number(upper), (upper ? 1 : -1) * away * x, away * y]; // both as seen from outside
}

/**
 * The map's lines, and a function that shows the trace up to a time.
 * @param {Record<string, any>} texts @param {{ bytes: Bytes, a: number, unit: number, width: number, height: number }} of
 */
export function caps(texts, { bytes, a, unit, width, height }) {
  const frames = new Frames(bytes), trace = traceOf(frames, a), wording = texts.answers.trace;
  const r = Math.max(Math.min((height - ROOM - 12) / 2, width / 4 - 8), 10), y0 = (height - ROOM) / 2;
  const middle = (cap) => width / 2 + (cap ? 1 : -1) * (r + 6);
  const at = trace.marks.map((mark) => {
    const [cap, x, y] = onCap(mark);
    return /** @type {[number, number, number]} */ ([cap, middle(cap) + r * x, y0 - r * y]);
  });
  const isJoined = (i) => i > 0 && trace.on[i] && trace.on[i - 1] && at[i][0] === at[i - 1][0];
  const steps = at.map(([, x, y], i) => (trace.on[i] ? `${isJoined(i) ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}` : ""));
  const { shapes: [rest, past, dot], move } = trail(steps);
  const rings = [0, 1].flatMap((cap) => RINGS.map((ring) =>
    drawn("circle", { class: ring === 90 ? "axis" : "grid", cx: middle(cap), cy: y0, r: (r * ring) / 90, fill: "none" })));
  const words = [0, 1].flatMap((cap) => [
    ...RINGS.slice(0, 2).map((ring) => drawn("text", { class: "halo", x: middle(cap), y: y0 + (r * ring) / 90 - 4, "text-anchor": "middle" },
      say(texts, "{tilt}°", { tilt: [cap ? 180 - ring : ring, 0] }))),
    drawn("text", { x: middle(cap), y: y0 + r + ROOM - 4, "text-anchor": "middle" }, wording.caps[cap]),
  ]);
  const moveTo = (t) => {
    const count = passedBy(trace, frames.place(t / unit) + 1e-9), i = Math.max(count - 1, 0), [, x, y] = at[i];
    move(count, [x, y]);
    dot.style.display = trace.on[i] ? "" : "none";
  };
  return { lines: [...rings, rest, past, ...words, dot], move: moveTo };
}

// A track: all of it, what has passed, and where it is.
/** @param {string[]} steps of its path */
export function trail(steps) {
  const past = drawn("path", { class: "past" }), dot = drawn("circle", { class: "dot", r: 6 });
  return { shapes: [drawn("path", { class: "rest", d: steps.join("") }), past, dot], move: (/** @type {number} */ count, /** @type {number[]} */ [cx, cy]) => {
    dress(past, { d: steps.slice(0, count).join("") });
    dress(dot, { cx, cy });
  } };
}
