// Fig. 6: which motions roll, the selected one with its bead at the time of the clock, and where it goes if it slips.
import { coalesce, degrees, fill, float32, local, set, tidy } from "../data.js";
import { spotOf, valueAt } from "../figures/curves.js";
import { followClock } from "../figures/seeking.js";
import { followLook, lifeOf, report } from "../life.js";
import { timeOf } from "../motion/clock.js";
import { nameOf, ROLLS } from "../regimes.js";
import { dress, fontSize, part } from "../parts.js";
import { Hand } from "./hand.js";
import { Picture } from "./picture.js";
import { limitsFrom } from "./reading.js";
import { style } from "./style.js";

const STEPS = 100; // of a key, over the range of K_J

/**
 * What is drawn. state: as of app/widgets/plane_view.py; size: of the type; way: names of the tieline
 * @typedef {{ state: any, limits: Limits, path: Path | null, texts: Record<string, any>, way: string[], size: number, width: number, height: number }} PlaneScene
 */

// The columns of a table of float32.
/** @param {Bytes} bytes @param {string[]} names @returns {any} */
function columnsOf(bytes, names) {
  const rows = float32(bytes), count = rows.length / names.length;
  return Object.fromEntries(names.map((name, i) => [name, Float32Array.from({ length: count }, (_, row) => rows[names.length * row + i])]));
}

export class PlaneFigure {
  /** @param {Rendering<PlaneModel>} rendering */
  constructor(rendering) {
    const { model, el } = rendering, { texts } = model, life = lifeOf(rendering);
    this.model = model;
    this.now = timeOf(model.clock);
    this.pictures = this.presses = 0;
    this.theta = NaN; // where the bead is
    /** @type {any} */
    this.state = null; // until something is drawn
    this.limits = limitsFrom(null, []);
    this.motion = columnsOf(null, ["t", "theta"]);
    /** @type {Path | null} */
    this.path = null;
    /** @type {Record<string, any>} */
    this.read = {}; // the bytes that were read last
    this.drawnAs = "";
    this.picture = new Picture(Object.fromEntries(["line", "end", "bead"].map((name) => [name, {
      role: "slider", tabindex: 0, "data-grip": name, "aria-label": texts.grips[name], "aria-orientation": name === "line" ? "vertical" : "horizontal",
    }])));
    this.drawing = this.picture.element;
    this.old = part("b", { class: "small", role: "status" });
    this.roads = Object.fromEntries(["slip", "paper"].map((road) =>
      [road, part("button", { type: "button", class: "outline", hidden: true, onclick: () => set(model, "pressed", [++this.presses, road]) }, texts.roads[road])]));
    this.symbols = Object.fromEntries(["up", "down", "across"].map((name) => [name, part("span", { class: `symbol ${name}` })]));
    for (const [name, symbol] of Object.entries(this.symbols)) symbol.innerHTML = texts[name]; // as Python wrote it, with its meaning
    const { up, down, across } = this.symbols;
    this.element = part("section", { class: "plane", "data-figure": "plane" },
      part("div", { class: "titled" }, up, this.old, ...Object.values(this.roads)), part("div", { class: "plot" }, this.drawing, down, across));
    this.frame = part("div", { class: "frame" }, this.element);
    el.replaceChildren(part("style", {}, style), this.frame);
    this.hand = new Hand(this, life);
    this.update = coalesce(() => this.show(), life);
    new ResizeObserver(this.update).observe(this.drawing);
    followLook(this.frame, life, this.update);
    for (const name of ["state", "motion", "limits", "field", "path"]) model.on(name, this.update);
    followClock(({ t }) => this.at(t), model.clock, life);
    report("plane", () => this.report(), life);
  }

  // Of a key that moves K_J.
  get step() {
    const [low, high] = this.state.K_J_range;
    return Number(((high - low) / STEPS).toPrecision(1));
  }

  // Whether these bytes are others than before; reads them if so.
  isNew(name, read) {
    if (this.read[name] === this.model[name]) return false;
    this.read[name] = this.model[name];
    read(this.model[name]);
    return true;
  }

  // Draws what has changed.
  show() {
    const { model, picture, drawing } = this, { texts } = model, state = JSON.parse(model.state), { clientWidth: width, clientHeight: height } = drawing;
    if (state.K_J === undefined || !state.K_J_range || !model.limits?.byteLength || !width || !height) return;
    const size = fontSize(drawing), drawnAs = [width, height, size, state.theta_range, state.K_J_range, state.mu_s].join();
    const hasLimits = this.isNew("limits", (bytes) => (this.limits = limitsFrom(bytes, texts.limited_by)));
    const isAnew = hasLimits || drawnAs !== this.drawnAs;
    const goes = this.isNew("path", (bytes) => (this.path = bytes?.byteLength ? columnsOf(bytes, ["theta", "low", "high", "K_J", "K_R"]) : null));
    this.isNew("motion", (bytes) => (this.motion = columnsOf(bytes, ["t", "theta"])));
    Object.assign(this, { state, drawnAs });
    const way = state.worst === ROLLS ? texts.names.rolls : [texts.ways[nameOf(state.worst)]];
    picture.show({ state, limits: this.limits, path: this.path, texts, way, size, width, height }, isAnew, isAnew || goes);
    this.symbols.down.style.top = `${picture.plots.routh.box.top - 0.9 * size}px`;
    this.showBeside();
    this.speak();
    this.at(this.now);
    this.hand.told();
    this.pictures += 1;
  }

  // The buttons, and that it is an old picture.
  showBeside() {
    const { state, model: { texts } } = this, [K_J, K_R, E] = (state.old ?? []).map((number) => local(number));
    for (const [road, button] of Object.entries(this.roads)) button.hidden = !state.roads.includes(road);
    this.element.classList.toggle("old", Boolean(state.old));
    const old = state.old ? fill(texts.old, { K_J, K_R, E }) : "";
    if (this.old.innerHTML !== old) this.old.innerHTML = old;
  }

  // To the ear.
  speak() {
    const { state, model: { texts } } = this, tilt = (value) => local(degrees(value).toFixed(1));
    const says = { K_J: tidy(state.K_J, 4), inner: tilt(state.inner), outer: tilt(state.outer), way: texts.ways[nameOf(state.worst)] };
    this.drawing.setAttribute("aria-label", `${texts.figure}. ${fill(texts.selected, says)}`);
    this.value("line", state.K_J_range, state.K_J, says.K_J);
    this.value("end", [0, 180], degrees(state.outer), `${says.outer}°`);
  }

  /** @param {"line" | "end" | "bead"} grip @param {[number, number]} range @param {number} now @param {string} text */
  value(grip, [least, most], now, text) {
    const slider = this.picture.chosen.grips[grip];
    if (slider.getAttribute("aria-valuetext") === text) return;
    dress(slider, { "aria-valuemin": Math.min(least, now), "aria-valuemax": Math.max(most, now), "aria-valuenow": now, "aria-valuetext": text });
  }

  // The bead at a time of the clock; the motion repeats.
  /** @param {number} t */
  at(t) {
    this.now = t;
    const { motion, state } = this;
    if (!(motion.t.length > 1)) return;
    this.theta = valueAt(motion.theta, spotOf(motion.t, t - (state.period > 0 ? Math.floor(t / state.period) * state.period : 0)));
    this.picture.at(this.theta);
    this.value("bead", [0, 180], degrees(this.theta), `${local(degrees(this.theta).toFixed(1))}°`);
  }

  // For tests: what is shown, and where.
  report() {
    const { picture, drawing, pictures, state, theta, limits, path } = this, names = [...drawing.querySelectorAll(".name")].map((name) => name.textContent);
    const pixel = (tilt, value, plot = "plane") => {
      const { left, top } = drawing.getBoundingClientRect(), { x, y } = picture.plots[plot];
      return [left + x(tilt), top + y(value)];
    };
    return { bar: picture.chosen.parts.bar, pictures, selected: state && { ...state, theta }, limits, path, names, pixel };
  }
}

/** @param {Rendering<PlaneModel>} rendering */
export const renderPlane = (rendering) => void new PlaneFigure(rendering);
