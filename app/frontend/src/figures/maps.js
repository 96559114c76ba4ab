// A map. Dragging moves the bead if it starts near it, and draws a box elsewhere, but not with a finger, which scrolls
// there; a click chooses a cell. `hand` sends all of this to Python, a box as two opposite corners. The arrow keys move
// the bead from cell to cell.
import { elementOf, eventsOf, scalesOf } from "../borrowed.js";
import { clamp } from "./curves.js";
import { gestureOf, isFollowed } from "./seeking.js";

const REACH = 40; // px
const LEAST = 12; // px: the smallest box
const WAIT = 80; // ms between two positions that are sent while the pointer moves

// For each hand: whether it is a finger, whether it holds the bead, the corner where its box begins, and when a position
// was last sent.
/** @typedef {{ x: number, y: number, sx: number, sy: number }} Corner */
/** @typedef {{ finger: boolean, held: boolean, from: Corner | null, sent: number }} Hand */
/** @typedef {{ setv(values: object): void }} Settable */
/** @type {WeakMap<object, Hand>} */
const hands = new WeakMap();

/** @param {object} hand */
function stateOf(hand) {
  if (!hands.has(hand)) hands.set(hand, { finger: false, held: false, from: null, sent: 0 });
  return /** @type {Hand} */ (hands.get(hand));
}

// The distance of the bead from a place, in px.
/** @param {Pick<Source<"x" | "y">, "data">} bead @param {number[]} place @param {Record<"x" | "y", Pick<PixelScale, "compute">>} scales */
const awayFromBead = ({ data }, [px, py], { x, y }) => Math.hypot(x.compute(data.x[0]) - px, y.compute(data.y[0]) - py);

/** @param {{ fig: Figure, hand: Source, bead: Source<"x" | "y">, box: Settable }} given @param {Happened} event */
export function pullBead({ fig, hand, bead, box }, event) {
  const { sx, sy, x, y } = event, name = gestureOf(event), own = stateOf(hand), clicked = name === "tap";
  const { x_range: across, y_range: up } = fig;
  const place = { x: clamp(x, across.start, across.end), y: clamp(y, up.start, up.end) };
  if (name === "panstart") {
    own.held = awayFromBead(bead, [sx, sy], scalesOf(fig)) < REACH;
    own.from = own.held || own.finger ? null : { ...place, sx, sy };
  }
  if (!clicked && own.from) return drawBox(own, hand, box, name, { ...place, sx, sy });
  if (!clicked && !own.held) return;
  const at = { x: [place.x], y: [place.y] };
  bead.setv({ data: at });
  const done = clicked || name === "panend", now = performance.now();
  if (done) own.held = false;
  if (!done && now - own.sent < WAIT) return;
  own.sent = now;
  hand.data = { ...at, cell: [Number(clicked)] };
}

// Draws the box from where the drag began to where it is; sends it when the drag ends.
/** @param {Hand} own @param {Source} hand @param {Settable} box @param {string} name @param {Corner} to */
function drawBox(own, hand, box, name, to) {
  const { from } = own, done = name === "panend";
  if (!from) return;
  const [left, right] = [from.x, to.x].sort((a, b) => a - b), [bottom, top] = [from.y, to.y].sort((a, b) => a - b);
  box.setv({ left, right, bottom, top, visible: !done });
  if (!done) return;
  own.from = null;
  if (Math.min(Math.abs(to.sx - from.sx), Math.abs(to.sy - from.sy)) < LEAST) return;
  hand.data = { x: [left, right], y: [bottom, top], cell: [0, 0] };
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };

// Where a key moves the bead: by one cell, with Shift by a tenth of one, and never off the map.
/**
 * @param {string} key @param {boolean} fine @param {[x: number, y: number]} place @param {Record<"x_range" | "y_range", { start: number, end: number }>} ranges
 * @param {[across: number, up: number]} cells
 */
export function keyed(key, fine, [x, y], { x_range: across, y_range: up }, cells) {
  const [right, above] = ARROWS[key], steps = cells.map((count) => (fine ? 10 : 1) * count);
  return [
    clamp(x + (right * (across.end - across.start)) / steps[0], across.start, across.end),
    clamp(y + (above * (up.end - up.start)) / steps[1], up.start, up.end),
  ];
}

/** @param {{ fig: Figure, hand: Source, bead: Source<"x" | "y">, map: Source<"image"> }} given */
export function moveBead({ fig, hand, bead, map }) {
  const element = elementOf(fig);
  if (!element) return;
  element.tabIndex = 0;
  element.onkeydown = (event) => {
    const [up, across] = map.data.image[0]?.shape ?? [];
    if (!(event.key in ARROWS) || !across || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const [x, y] = keyed(event.key, event.shiftKey, [bead.data.x[0], bead.data.y[0]], fig, [across, up]), at = { x: [x], y: [y] };
    bead.setv({ data: at });
    hand.data = { ...at, cell: [0] };
  };
}

// A finger near the bead moves the bead; anywhere else it scrolls the page.
/** @param {{ fig: Figure, bead: Source<"x" | "y">, hand: Source }} given */
export function keepFinger({ fig, bead, hand }) {
  if (isFollowed(bead)) return;
  const events = eventsOf(fig);
  const onPointer = ({ pointerType }) => (stateOf(hand).finger = pointerType === "touch");
  events.addEventListener("pointerdown", onPointer, { capture: true });
  const onTouch = (event) => {
    const { left, top } = events.getBoundingClientRect(), [{ clientX, clientY }] = event.touches;
    const near = awayFromBead(bead, [clientX - left, clientY - top], scalesOf(fig)) < REACH;
    if (event.touches.length === 1 && near) event.preventDefault();
  };
  events.addEventListener("touchstart", onTouch, { passive: false });
}
