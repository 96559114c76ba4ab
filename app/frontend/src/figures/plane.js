// Fig. 6: the bead at the time of the clock, and the pointer, which `hand` sends to Python.
import { eventsOf, scalesOf, setCursor } from "../borrowed.js";
import { fill, local } from "../data.js";
import { timeOf } from "../motion/clock.js";
import { ROLLS, wordOf } from "../regimes.js";
import { clamp, nearestRow, spotOf, timeAtTilt, valueAt } from "./curves.js";
import { awayFromTieline, gripAt, isOn, REACH } from "./grips.js";
import { hideReadout, showReadout } from "./readout.js";
import { LAB, followClock, gestureOf, isFollowed, seek } from "./seeking.js";

const CURSORS = { bead: "grab", end: "ew-resize", line: "ns-resize" };

// For each hand: where it was pressed, whether it is a finger that scrolls the page, and where it is now.
/** @type {WeakMap<object, { grip: string | null, pressed?: [number, number], scrolls: boolean, at?: [number, number] }>} */
const hands = new WeakMap();

function handOf(hand) {
  const own = hands.get(hand) ?? { grip: null, scrolls: false };
  hands.set(hand, own);
  return own;
}

/** @returns {any} */
const rowOf = (source) => Object.fromEntries(Object.entries(source.data).map(([name, values]) => [name, values[0]]));

/** @param {{ fig: Figure, hand: Source, motion: Source<"t" | "theta">, selected: Source<"theta"> }} given */
export function followMotion({ fig, hand, motion, selected }) {
  if (isFollowed(motion)) return;
  let now = 0;
  const placeBead = () => {
    const { t, theta } = motion.data;
    selected.data.theta[0] = valueAt(theta, spotOf(t, now));
    selected.change.emit();
  };
  motion.properties.data.change.connect(placeBead);
  followClock((t) => {
    now = t;
    placeBead();
  });
  now = timeOf(LAB);
  placeBead(); // a paused clock sends no events
  const events = eventsOf(fig);
  const onTieline = ({ clientX, clientY }) => {
    const { left, top } = events.getBoundingClientRect();
    return awayFromTieline(rowOf(selected), clientX - left, clientY - top, scalesOf(fig)) < REACH;
  };
  const press = (event) => {
    const own = handOf(hand);
    own.pressed = [event.offsetX, event.offsetY];
    own.scrolls = event.pointerType === "touch" && !onTieline(event);
  };
  events.addEventListener("pointerdown", press, { capture: true });
  // A finger on the selected tieline drags it; anywhere else it scrolls the page.
  const keep = (event) => {
    if (event.touches.length === 1 && onTieline(event.touches[0])) event.preventDefault();
  };
  events.addEventListener("touchstart", keep, { passive: false });
  events.addEventListener("pointerleave", () => !handOf(hand).grip && hideReadout(hand));
  window.addEventListener("scroll", () => hideReadout(hand), { capture: true, passive: true });
}

/** @param {Record<string, any> & { motion: Source }} given @param {Happened} event */
export function pullPlane(given, event) {
  const { fig, hand, selected, limits } = given, { x, y } = event, name = gestureOf(event);
  const own = handOf(hand), row = rowOf(selected), scales = scalesOf(fig);
  const at = (point) => gripAt(row, limits.data, point, [x, y], scales);
  const over = () => at([scales.x.compute(x), scales.y.compute(y)]);
  own.at = [x, y];
  if (name === "mousemove") {
    if (own.grip) return;
    setCursor(fig, CURSORS[over()] ?? "pointer");
    return sayPlace(given);
  }
  // a fast pointer has moved on by the time Bokeh calls it a drag
  if (name === "panstart") own.grip = own.scrolls ? null : own.pressed ? at(own.pressed) : over();
  if (name === "tap") own.grip = over();
  const taken = own.grip, done = name === "tap" || name === "panend";
  if (done) own.grip = null;
  if (taken === "bead" || (name === "tap" && taken === "line")) moveClock(given, row, x, !done);
  else if (taken && !(name === "tap" && taken === "end") && name !== "panend") {
    const { K_J } = limits.data;
    const on = taken === "end" ? row.K_J : taken === "tieline" && done ? K_J[nearestRow(K_J, y)] : y;
    hand.data = { grip: [taken], theta: [x], K_J: [on] };
  }
  if (name === "tap") sayPlace(given);
  else sayPull(given);
}

function moveClock({ motion }, { inner, outer }, theta, held) {
  const aim = clamp(theta, Math.min(inner, outer), Math.max(inner, outer));
  seek(timeAtTilt(motion.data, aim, timeOf(LAB)), held);
}

// A place in the plane and the selected tieline, in px of the window.
function onWindow(fig, [x, y], { inner, outer, K_J }) {
  const { left, top } = eventsOf(fig).getBoundingClientRect(), scales = scalesOf(fig);
  const across = (theta) => left + scales.x.compute(theta), down = (value) => top + scales.y.compute(value);
  const line = { left: across(inner) - REACH, right: across(outer) + REACH, top: down(K_J) - REACH, bottom: down(K_J) + REACH };
  /** @type {[number, number]} */
  const at = [across(x), down(y)];
  return { at, line };
}

function say(given, words) {
  const { fig, hand, selected } = given, { at } = handOf(hand);
  if (!at) return;
  const place = onWindow(fig, at, rowOf(selected));
  showReadout(hand, words, place.at, [place.line]);
}

// While the pointer drags: why the motion there is impossible.
/** @param {Record<string, any>} given */
export function sayPull(given) {
  const { hand, selected, pulled } = given, { at, grip } = handOf(hand), [worst] = selected.data.worst;
  if (!at) return;
  const words = grip && grip !== "bead" && worst !== ROLLS ? wordOf(worst, pulled) : undefined;
  if (words) say(given, words);
  else if (grip) hideReadout(hand);
}

// The value of a field at a place. The field is an image whose first row is the lowest.
/** @param {Record<"x" | "y" | "w" | "h", number[]>} frame @param {{ shape: number[] } & Column} values @param {[x: number, y: number]} place */
export function valueIn({ x: [x], y: [y], w: [w], h: [h] }, values, [across, up]) {
  const [rows, columns] = values.shape, inside = (share, all) => clamp(Math.floor(share * all), 0, all - 1);
  return values[inside((up - y) / h, rows) * columns + inside((across - x) / w, columns)];
}

// Says what is at the place under the pointer.
function sayPlace(given) {
  const { fig, hand, limits, field, words } = given, own = handOf(hand), [x, y] = /** @type {[number, number]} */ (own.at);
  const { x_range: { end }, y_range: high } = fig;
  if (!(field.data.E.length && x >= 0 && x <= end && y >= high.start && y <= high.end)) return hideReadout(hand);
  const [E, ratio] = ["E", "ratio"].map((name) => valueIn(field.data, field.data[name][0], [x, y]));
  say(given, readPlane(limits.data, words, { x, y, E, ratio }));
}

// What is at a place, which alone decides the verdict: on a row's tieline the top rolls, with the energy of that row.
// E: the energy at the place from the field, whose numbers are rounded and whose cells are as wide as a degree.
/** @param {Record<string, any>} limits @param {Record<string, string>} words @param {Record<"x" | "y" | "E" | "ratio", number>} place */
export function readPlane({ K_J, slip_in, slip_out, lift_in, lift_out, slip_E, slip_by, lift_by }, words, { x, y, E, ratio }) {
  const row = nearestRow(K_J, y), rolls = isOn(slip_in, slip_out, row, x);
  const limited = { slip: words.then_slip, "lift-off": words.then_lift, "no motion": words.steady_cannot, nothing: words.unlimited };
  const why = { slip: words.not_slip, "lift-off": words.not_lift };
  const limit = isOn(lift_in, lift_out, row, x) ? slip_by[row] : lift_by[row];
  const verdict = rolls || !(slip_by[row] in why) ? limited[slip_by[row]] : (why[limit] ?? words.not_at_all);
  const energy = rolls && Number.isFinite(slip_E[row]) ? slip_E[row] : E;
  return fill(words.place, {
    K_J: local(K_J[row].toFixed(3)), theta: local(x.toFixed(3)), degrees: local(((x * 180) / Math.PI).toFixed(1)), E: local(energy.toFixed(4)),
    ratio: Number.isFinite(ratio) ? local(ratio.toFixed(3)) : words.no_contact, verdict,
  });
}
