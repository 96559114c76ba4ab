// A hand on Fig. 6: what it grabs, what it asks for, and what it is told. The bead moves the clock, in the browser alone.
import { set } from "../data.js";
import { clamp, nearestRow, timeAtTilt } from "../figures/curves.js";
import { hideReadout, showReadout } from "../figures/readout.js";
import { seek } from "../figures/seeking.js";
import { atEnd } from "../life.js";
import { ROLLS, wordOf } from "../regimes.js";
import { awayFromTieline, gripAt, REACH } from "./grips.js";
import { readPlane, valuesIn } from "./reading.js";
/** @import { PlaneFigure } from "./plane.js" */

const CURSORS = { bead: "grab", end: "ew-resize", line: "ns-resize" };
const STILL = 2; // px: a press that moves less is a click
const TILT = 0.01, FAST = 10, HELD = 500; // rad a key; times as far; ms that a key counts on the one before

export class Hand {
  /** @param {PlaneFigure} figure @param {AbortSignal} signal its life */
  constructor(figure, signal) {
    this.figure = figure;
    /** @type {{ grip: string, from: [number, number], scrolls: boolean, moved: boolean } | null} */
    this.press = null;
    /** @type {[x: number, y: number] | null} */
    this.at = null; // px of the drawing
    this.keyed = { name: "", value: 0, when: -Infinity };
    const on = (name, run, more = {}) => figure.drawing.addEventListener(name, run, more);
    on("pointerdown", (event) => this.take(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.release(event));
    on("pointercancel", () => this.cancel());
    on("pointerleave", () => !this.grip && hideReadout(this));
    on("keydown", (event) => this.key(event));
    // A finger on the selected tieline drags it; anywhere else it scrolls the page.
    on("touchstart", (event) => event.touches.length === 1 && this.isOnTieline(this.pointOf(event.touches[0])) && event.preventDefault(), { passive: false });
    window.addEventListener("scroll", () => hideReadout(this), { capture: true, passive: true, signal });
    atEnd(signal, () => hideReadout(this));
  }

  // What is held.
  get grip() { return this.press?.moved && !this.press.scrolls ? this.press.grip : null; }

  get scales() {
    const { x, y } = this.figure.picture.plots.plane;
    return { x, y };
  }

  /** @returns {[number, number]} */
  pointOf({ clientX, clientY }) {
    const { left, top } = this.figure.drawing.getBoundingClientRect();
    return [clientX - left, clientY - top];
  }

  /** @returns {[theta: number, K_J: number]} */
  placeOf([px, py]) { return [this.scales.x.invert(px), this.scales.y.invert(py)]; }

  isOnTieline([px, py]) {
    return Boolean(this.figure.state) && awayFromTieline(this.figure.state, px, py, this.scales) < REACH;
  }

  gripAt(point) {
    const { state: shown, theta, limits } = this.figure;
    return gripAt({ ...shown, theta }, limits, point, this.placeOf(point), this.scales);
  }

  // Whether a place is in the plane, or as near to it as a hand is to what it grabs.
  isNear([px, py], reach = REACH) {
    const { state, picture: { plots, inset: { box: inset } } } = this.figure;
    if (!state) return false;
    const { left, right, top, bottom } = plots.plane.box;
    const covered = inset && px > inset.left && py > inset.top && px < inset.right && py < inset.bottom;
    return !covered && px >= left - reach && px <= right + reach && py >= top - reach && py <= bottom + reach;
  }

  take(event) {
    const point = this.pointOf(event);
    if (event.button || !event.isPrimary || !this.isNear(point)) return;
    const scrolls = event.pointerType === "touch" && !this.isOnTieline(point);
    this.press = { grip: this.gripAt(point), from: point, scrolls, moved: false };
    if (!scrolls) this.figure.drawing.setPointerCapture(event.pointerId);
  }

  move(event) {
    const point = this.pointOf(event), { press } = this;
    this.at = point;
    if (!press) return this.hover();
    press.moved ||= Math.hypot(point[0] - press.from[0], point[1] - press.from[1]) >= STILL;
    if (this.grip) this.pull(point, false);
  }

  release(event) {
    const { press } = this, point = this.pointOf(event);
    if (!press) return;
    this.at = point;
    if (this.grip) this.pull(point, true);
    this.press = null;
    if (!press.moved) this.click(point, press.grip);
    if (event.pointerType === "touch" && press.moved) hideReadout(this);
  }

  cancel() {
    if (this.grip === "bead") seek(this.figure.now, false, this.figure.model.clock);
    this.press = null;
    hideReadout(this);
  }

  click(point, grip) {
    const [theta, K_J] = this.placeOf(point);
    if (grip === "bead" || grip === "line") this.moveClock(theta, false);
    else if (grip !== "end") this.ask(grip, theta, grip === "tieline" ? this.rowNear(K_J) : K_J);
    this.hover();
  }

  pull(point, done) {
    const [theta, K_J] = this.placeOf(point), grip = /** @type {string} */ (this.grip);
    if (grip === "bead") this.moveClock(theta, !done);
    else this.ask(grip, theta, grip === "end" ? this.figure.state.K_J : grip === "tieline" && done ? this.rowNear(K_J) : K_J);
    this.told();
  }

  rowNear(K_J) {
    const { limits } = this.figure;
    return limits.K_J[nearestRow(limits.K_J, K_J)];
  }

  ask(grip, theta, K_J) {
    set(this.figure.model, "hand", [grip, clamp(theta, 0, Math.PI), K_J]);
  }

  // The clock may be in a later nutation than the one that is known.
  moveClock(theta, held) {
    const { motion, state: shown, now, model } = this.figure, { inner, outer, period } = shown;
    const turns = period > 0 ? Math.max(Math.floor(now / period), 0) * period : 0;
    seek(turns + timeAtTilt(motion, clamp(theta, inner, outer), now - turns), held, model.clock);
  }

  hover() {
    const { at, figure } = this;
    if (!at || !this.isNear(at)) {
      figure.drawing.style.cursor = "";
      return hideReadout(this);
    }
    figure.drawing.style.cursor = CURSORS[this.gripAt(at)] ?? "pointer";
    if (!this.isNear(at, 1)) return hideReadout(this);
    const { limits, model, state } = figure, [x, y] = this.placeOf(at);
    const values = valuesIn(model.field, state.field, state.theta_range[1], [x, y]);
    this.say(readPlane(limits, model.texts, { x: clamp(x, 0, Math.PI), y, ...values }));
  }

  // While the pointer drags: why the motion there is impossible.
  told() {
    const { grip, figure } = this, { worst } = figure.state;
    if (!grip) return;
    const words = grip !== "bead" && worst !== ROLLS ? wordOf(worst, figure.model.texts.regimes) : undefined;
    if (words) this.say(words);
    else hideReadout(this);
  }

  // Beside the hand, clear of the selected tieline.
  say(words) {
    const { state: shown } = this.figure, { left, top } = this.figure.drawing.getBoundingClientRect(), { x, y } = this.scales;
    const [px, py] = /** @type {[number, number]} */ (this.at), level = top + y(shown.K_J);
    showReadout(this, words, [left + px, top + py],
      [{ left: left + x(shown.inner) - REACH, right: left + x(shown.outer) + REACH, top: level - REACH, bottom: level + REACH }]);
  }

  // Arrow keys move what has the focus: K_J, the outer end, or the bead.
  key(event) {
    const name = event.target.closest?.(".grip")?.dataset.grip, sign = { ArrowUp: 1, ArrowRight: 1, PageUp: FAST, ArrowDown: -1, ArrowLeft: -1, PageDown: -FAST }[event.key];
    if (!name || !sign || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { figure, keyed } = this, { state: shown, now } = figure, goesOn = keyed.name === name && event.timeStamp - keyed.when < HELD;
    const { value, step } = { line: { value: shown.K_J, step: figure.step }, end: { value: shown.outer, step: TILT }, bead: { value: now, step: shown.period / 64 } }[name];
    const next = (goesOn ? keyed.value : value) + sign * step;
    this.keyed = { name, value: next, when: event.timeStamp };
    if (name === "bead") seek(Math.max(next, 0), false, figure.model.clock);
    else if (name === "line") this.ask("line", shown.inner, Number(next.toFixed(9)));
    else this.ask("end", next, shown.K_J);
  }
}
