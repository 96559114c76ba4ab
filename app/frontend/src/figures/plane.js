// Fig. 6: the bead at the clock's time, and a hand, which `hand` takes to Python.
import { eventsOf, leaveHover, scalesOf, setCursor } from "../borrowed.js";
import { timeOf } from "../motion/clock.js";
import { ROLLS, wordOf } from "../regimes.js";
import { clamp, nearestRow, spotOf, timeAtTilt, valueAt } from "./curves.js";
import { awayFromTieline, gripAt, REACH } from "./grips.js";
import { followClock, isFollowed, seek } from "./seeking.js";

const CURSORS = { bead: "grab", end: "ew-resize", line: "ns-resize" };

// hand -> what is known of it. pressed: where it went down; scrolls: a finger there moves the page; at: where it is.
/** @type {WeakMap<object, { grip: string | null, pressed?: [number, number], scrolls: boolean, at?: [number, number] }>} */
const hands = new WeakMap();

function handOf(hand) {
  const own = hands.get(hand) ?? { grip: null, scrolls: false };
  hands.set(hand, own);
  return own;
}

/** @returns {any} */
const rowOf = (source) => Object.fromEntries(Object.entries(source.data).map(([name, values]) => [name, values[0]]));

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
  // A finger pulls the tieline on display, and scrolls the page from everywhere else.
  const keep = (event) => {
    if (event.touches.length === 1 && onTieline(event.touches[0])) event.preventDefault();
  };
  events.addEventListener("touchstart", keep, { passive: false });
}

export function pullPlane(given, event) {
  const { fig, hand, selected, limits, hover } = given, { x, y, event_name: name } = event;
  const own = handOf(hand), row = rowOf(selected), scales = scalesOf(fig);
  const at = (point) => gripAt(row, limits.data, point, [x, y], scales);
  const over = () => at([scales.x.compute(x), scales.y.compute(y)]);
  if (name === "mousemove") {
    if (!own.grip) setCursor(fig, CURSORS[over()] ?? "pointer");
    return;
  }
  // a quick hand is elsewhere by the time it counts as dragging
  if (name === "panstart") own.grip = own.scrolls ? null : own.pressed ? at(own.pressed) : over();
  if (name === "tap") own.grip = over();
  const taken = own.grip, done = name === "tap" || name === "panend";
  if (done) own.grip = null;
  if (name === "panstart") leaveHover(fig, hover);
  hover.setv({ active: !own.grip }, { sync: false });
  if (taken === "bead" || (name === "tap" && taken === "line")) moveClock(given, row, x, !done);
  else if (taken && !(name === "tap" && taken === "end") && name !== "panend") {
    const { K_J } = limits.data;
    const on = taken === "end" ? row.K_J : taken === "tieline" && done ? K_J[nearestRow(K_J, y)] : y;
    hand.data = { grip: [taken], theta: [x], K_J: [on] };
  }
  own.at = [x, y];
  sayPull(given);
}

function moveClock({ motion }, { inner, outer }, theta, held) {
  const aim = clamp(theta, Math.min(inner, outer), Math.max(inner, outer));
  seek(timeAtTilt(motion.data, aim, timeOf()), held);
}

// Why not, where the hand is.
export function sayPull({ fig, hand, selected, sentence, words }) {
  const { at, grip } = handOf(hand), [worst] = selected.data.worst;
  if (!at) return;
  const visible = Boolean(grip) && grip !== "bead" && worst !== ROLLS;
  if (!visible && !sentence.visible) return;
  const [x, y] = at, right = x > (fig.x_range.start + fig.x_range.end) / 2;
  const align = right ? { text_align: "right", x_offset: -12 } : { text_align: "left", x_offset: 12 };
  sentence.setv({ x, y, text: wordOf(worst, words) ?? " ", visible, ...align }, { sync: false });
}

// What stands at a place, beside the mouse. format: which of it.
export function readPlane({ limits, words }, { value, format, x, y }) {
  const { K_J, slip_E, lift_E, slip_by, lift_by } = limits.data, row = nearestRow(K_J, y);
  if (format === "K_J") return K_J[row].toFixed(3);
  if (format === "theta") return `${x.toFixed(3)} rad = ${((x * 180) / Math.PI).toFixed(1)}°`;
  if (format === "E") return `${value.toFixed(4)} MgR`;
  if (format === "ratio") return Number.isFinite(value) ? value.toFixed(3) : words.no_contact;
  const limited = { slip: words.then_slip, "lift-off": words.then_lift, "no motion": words.steady_cannot, nothing: words.unlimited };
  if (!(value > slip_E[row])) return limited[slip_by[row]];
  const why = { slip: words.not_slip, "lift-off": words.not_lift };
  return why[value > lift_E[row] ? lift_by[row] : slip_by[row]] ?? words.not_at_all;
}
