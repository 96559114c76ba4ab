// Shows one picture at a time; each answers a question about the run: where the height comes from, which way the top
// turns, where it touches the table, and the ball.
import { caps, trail } from "./caps.js";
import { meets } from "../data.js";
import { ENERGY, HEAT, HEIGHT, SPIN, ticks, TURNING } from "../motion/curves.js";
import { levels as grid, marks, times } from "../figures/line.js";
import { lineOf } from "./numbers.js";
import { Choice, drawn, dress, fontSize, part, say } from "../parts.js";
import { Frames } from "../motion/frames.js";

const NAMES = ["energy", "spin", "path", "trace"];
const READ = { energy: ["height", "energy", "heat"], spin: ["spin", "turning"] }; // shown at the pointer; names of numbers.js
const RIGHT = 10, TOP = 10, FOOT = 22; // px around a plot
// In font sizes: what stands left of a plot; the room that words need in a picture; a line of text between two curves; how
// long the name of the spin, the heights and the cause of the heat are.
const LEFT = 3.3, ROOM = 2.1, LINE = 1.7, SPINS = 2.5, NUMBERS = 9.5, CAUSE = 10.3;
const MOST_POINTS = 2400;
const NAMED = [0.3, 0.15, 0.45, 0.6, 0.75, 0.02]; // fractions of the earlier run at which its name may be
const JUMP = 0.5; // R: the contact moves this far between two frames only if another part of the top touches down

export class Answer {
  /** @param {Record<string, any>} texts @param {import("./time.js").Time} time @param {() => void} chosen another picture is shown */
  constructor(texts, time, chosen) {
    this.chosen = chosen;
    this.texts = texts;
    this.time = time;
    this.width = this.height = this.bottom = this.size = this.left = 0; // px; not known yet; size: of the font
    /** @type {((t: number) => void)[]} */
    this.moves = []; // functions that draw the parts that move differently
    this.name = "energy";
    /** @type {((share: number) => [x: number, y: number, ground?: string]) | null} */
    this.unnamed = null; // where the name of the earlier run goes, at a fraction of that run
    /** @type {import("../motion/curves.js").Curves | null} */
    this.before = null;
    this.title = part("h2");
    this.note = part("p", { class: "small" });
    this.choice = new Choice({
      role: "tab", label: texts.pictures, kind: "mini", options: NAMES.map((name) => [name, texts.answers[name].tab]),
      choose: (name) => this.look(name),
    });
    this.drawing = drawn("svg", { role: "img" });
    this.readout = part("p", { class: "readout", hidden: true, "aria-hidden": "true" });
    this.plot = part("div", { class: "plot", role: "tabpanel" }, this.drawing, this.readout);
    this.larger = part("button", { type: "button", class: "icon", onclick: () => this.enlarge() });
    this.sign(false);
    this.dialog = part("dialog", { class: "large", "aria-label": texts.larger, onclose: () => this.shrink() });
    this.element = part("section", { class: "answer" },
      part("div", { class: "titled" }, this.title, this.choice.element, this.larger), this.note, this.plot);
    this.plot.onpointermove = (event) => this.point(event);
    this.plot.onpointerleave = () => (this.readout.hidden = true);
    new ResizeObserver(() => this.draw()).observe(this.plot);
  }

  // Fills the window; the same button or Escape ends that. All of it moves, so that it looks the same there.
  enlarge() {
    if (this.dialog.open) return this.dialog.close();
    this.element.replaceWith(this.dialog);
    this.dialog.append(this.element);
    this.sign(true);
    this.dialog.showModal();
    this.larger.focus();
    this.draw(); // now: a pointer that is already over it reads the new scale
  }

  shrink() {
    this.dialog.replaceWith(this.element);
    this.sign(false);
    this.larger.focus();
    this.draw();
  }

  // What the button does now.
  /** @param {boolean} isLarge */
  sign(isLarge) {
    const { larger, texts } = this, word = isLarge ? texts.smaller : texts.larger;
    larger.textContent = isLarge ? "×" : "⤢";
    larger.title = word;
    larger.setAttribute("aria-label", word);
  }

  // The numbers at the pointer.
  /** @param {PointerEvent} event */
  point({ clientX, clientY }) {
    const { readout, curves, name, texts } = this, box = this.plot.getBoundingClientRect(), x = clientX - box.left;
    const t = ((x - this.left) / (this.right - this.left)) * (this.time.span || 1);
    readout.hidden = !READ[name] || !curves?.count || t < 0 || t > this.time.end;
    if (readout.hidden) return;
    readout.textContent = lineOf(texts, curves, READ[name], t);
    readout.style.left = `${Math.max(0, Math.min(x + 14, this.width - readout.offsetWidth))}px`;
    readout.style.top = `${Math.max(0, clientY - box.top - 40)}px`;
  }

  look(name) {
    this.name = name;
    this.draw();
    this.chosen();
  }

  show(scene) {
    this.scene = scene;
    this.curves = scene.curves[scene.table === "three" ? "ordinary" : scene.table];
    const { before } = scene, then = before?.curves[before.table];
    this.before = then?.count ? then : null;
    this.draw();
  }

  get right() { return this.width - RIGHT; }

  x = (t) => this.left + ((this.right - this.left) * t) / (this.time.span || 1);

  draw() {
    const { clientWidth: width, clientHeight: height } = this.plot, { scene, name, texts } = this, wording = texts.answers[name];
    this.choice.show(name);
    this.title.textContent = wording.question;
    this.plot.setAttribute("aria-label", wording.question);
    this.drawing.setAttribute("aria-label", wording.note);
    if (!width || !scene) return;
    const isOld = Boolean(scene.state.old);
    // What is below stays in its place while a hand holds it.
    if (isOld !== this.note.classList.contains("cut")) this.note.style.minHeight = isOld && this.note.firstChild ? getComputedStyle(this.note).height : "";
    this.note.classList.toggle("cut", isOld);
    this.note.replaceChildren(...(isOld ? [part("b", {}, say(texts, texts.old, { what: scene.state.old })), ". "] : []), wording.note,
      ...(this.before && name !== "trace" ? [texts.note_then] : []), name === "trace" && scene.run?.trace ? ` ${scene.run.trace}` : "");
    const size = fontSize(this.plot);
    Object.assign(this, { width, height, size, left: LEFT * size, bottom: height - FOOT });
    this.now = drawn("line", { class: "now", y1: 0, y2: this.bottom });
    this.moves = [];
    this.drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.unnamed = null;
    this.drawing.replaceChildren(...(this.curves.count ? this[name]() : []));
    this.nameThen();
    this.at(this.time.t);
  }

  // Puts the name of the earlier run beside its line, where there is room.
  nameThen() {
    if (!this.unnamed) return;
    const name = drawn("text", {}, this.texts.then), others = [...this.drawing.querySelectorAll(".halo, .word")].map((word) => word.getBoundingClientRect());
    this.drawing.append(name);
    for (const share of [...NAMED, NAMED[0]]) { // if there is room nowhere, at the first
      const [x, y, ground = ""] = this.unnamed(share);
      dress(name, { class: `halo ${ground}`, x: x.toFixed(1), y: y.toFixed(1) });
      const box = name.getBoundingClientRect();
      if (!others.some((other) => meets(box, other))) return;
    }
  }

  /** @param {number} least @param {number} most @param {string} unit @param {number} apart px between two ticks */
  axes(least, most, unit, apart = 90) {
    const y = (value) => this.bottom - ((this.bottom - TOP) * (value - least)) / (most - least || 1), up = ticks(least, most, Math.max(2, this.height / apart));
    const number = (value) => say(this.texts, value === up.at(-1) ? `{value} ${unit}` : "{value}", { value: [value, Math.abs(value % 1) > 1e-9 ? 1 : 0] });
    return { y, found: [...grid(up, { y, left: this.left, right: this.right }, number), ...marks(ticks(0, this.time.span || 1, 6), this, times(this.texts))] };
  }

  // The earlier run, one quantity.
  /** @param {(value: number) => number} y @param {number} column */
  then(y, column) {
    const curves = this.before;
    if (!curves) return [];
    const end = Math.min(curves.end, this.time.end);
    this.unnamed = (share) => {
      const t = share * end, value = curves.at(t, column);
      return [this.x(t) + 4, y(value) - 5, column === ENERGY && value < this.curves.at(t, column) ? "washed" : ""];
    };
    return [drawn("polyline", { class: "then", points: curves.points((at) => Math.min(this.x(at), this.right), y, column) })];
  }

  /** @param {number[]} columns @returns {[least: number, most: number]} */
  range(...columns) {
    const [[least, most], then] = [this.curves.range(...columns), this.before?.range(...columns) ?? [Infinity, -Infinity]];
    return [Math.min(least, then[0]), Math.max(most, then[1])];
  }

  energy() {
    const { curves, texts } = this, wording = texts.answers.energy, start = curves.value(0, ENERGY);
    const levels = this.levels(), { y, found } = this.axes(0, 1.03 * Math.max(this.range(ENERGY)[1], ...levels.map(([, level]) => level)), "mm");
    const line = (column) => curves.points(this.x, y, column), floor = `${this.x(curves.end)},${this.bottom} ${this.left},${this.bottom}`;
    const heights = curves.range(HEIGHT), t = (share) => share * curves.end, at = (share, column) => y(curves.at(t(share), column));
    const words = [], put = (share, height, text, more, kind) => words.push(
      drawn("text", { class: `word halo ${kind}`, x: this.x(t(share)), y: height }, text),
      ...(more ? [drawn("text", { class: "halo", x: this.x(t(share)), y: height, dy: "1.3em" }, more)] : []));
    const [brief, long, wide] = [SPINS, NUMBERS, CAUSE].map((length) => (length * this.size) / (this.right - this.left));
    const room = ROOM * this.size, high = LINE * this.size, [low, top] = [HEIGHT, ENERGY].map((column) => at(0.04 + brief, column));
    if (low - top > room) put(0.04, (low + top) / 2 + 4, wording.spin, "", "washed");
    const isFree = (share) => [0, 0.5, 1].map((of) => of * long).every((more) => at(share + more, HEIGHT) - at(share + more, ENERGY) > high);
    const free = [0.4, 0.3, 0.2, 0.08, 0.02].find(isFree), stands = free ?? 0.4;
    const [least, most] = [curves.value(0, HEIGHT), heights[1]], text = most - least < 0.5 ? wording.height_same : wording.height;
    const over = (column) => Math.min(...[0, 0.5, 1].map((of) => at(stands + of * long, column))) - 8;
    const isHigh = this.bottom - at(stands, HEIGHT) > room && this.bottom - at(stands + long, HEIGHT) > room;
    // above the area of the height; if the energy leaves no room there, inside it; if it is too low, above both
    const [height, kind] = free ? [over(HEIGHT), "washed"] : isHigh ? [this.bottom - 10, "inside"] : [over(ENERGY), ""];
    const under = (share) => Math.min(at(share, ENERGY), at(share + wide, ENERGY), kind ? Infinity : height - high);
    const lost = [0.42, 0.3, 0.55].find((share) => under(share) - y(start) > 2 * room);
    if (lost) put(lost, (under(lost) + y(start)) / 2, wording.heat, wording.heat_by, "");
    put(stands, height, say(texts, text, { least: [least, 0], most: [most, 0] }), "", kind);
    return [
      ...found,
      drawn("polygon", { class: "spins", points: `${line(ENERGY)} ${floor}` }), drawn("polygon", { class: "lifts", points: `${line(HEIGHT)} ${floor}` }),
      drawn("polyline", { class: "energy", points: line(ENERGY) }), ...this.then(y, ENERGY),
      drawn("polyline", { class: "first", points: levels.map(([time, level]) => `${this.x(time)},${y(level)}`).join(" ") }), this.now, ...words,
    ];
  }

  // The energy and what has become heat: as at the start, and from each push on another, as points (t, energy).
  levels() {
    const { curves, scene, time } = this, events = scene.runs[scene.table === "three" ? "ordinary" : scene.table]?.events ?? [];
    const from = [0, ...events.filter(([, code]) => code === "push").map(([t]) => t)];
    return from.flatMap((t, i) => {
      const until = from[i + 1] ?? (time.span || 1), middle = (t + Math.min(until, curves.end)) / 2;
      const level = curves.at(middle, ENERGY) + curves.at(middle, HEAT) - curves.value(0, HEAT);
      return [[t, level], [until, level]];
    });
  }

  spin() {
    const { curves, texts } = this, wording = texts.answers.spin;
    const [least, most] = this.range(SPIN, TURNING), room = 0.06 * (most - least || 1);
    const { y, found } = this.axes(Math.min(least, 0) - (least < 0 ? 2 * room : 0), Math.max(most, 0) + room, wording.unit, 60);
    let widest = 0, apart = 0; // where the two lines are farthest apart
    for (let share = 0.2; share < 0.7; share += 0.05) {
      const gap = Math.abs(y(curves.at(share * curves.end, SPIN)) - y(curves.at(share * curves.end, TURNING)));
      if (gap > apart) [apart, widest] = [gap, share];
    }
    const words = [], put = (share, column, side, text) => words.push(drawn("text", {
      class: `word halo ${column === SPIN ? "own" : ""}`, x: this.x(share * curves.end), y: y(curves.at(share * curves.end, column)) + (side > 0 ? 20 : -10),
    }, text));
    if (apart < 2 * ROOM * this.size) put(0.4, SPIN, curves.at(0.4 * curves.end, SPIN) > (most + Math.min(least, 0)) / 2 ? 1 : -1, wording.both);
    else {
      put(widest, TURNING, curves.at(widest * curves.end, TURNING) > curves.at(widest * curves.end, SPIN) ? -1 : 1, wording.above);
      put(widest, SPIN, curves.at(widest * curves.end, TURNING) > curves.at(widest * curves.end, SPIN) ? 1 : -1, wording.own);
    }
    return [
      ...found, ...this.then(y, SPIN), drawn("polyline", { class: "turning", points: curves.points(this.x, y, TURNING) }),
      drawn("polyline", { class: "own", points: curves.points(this.x, y, SPIN) }), this.now, ...words,
    ];
  }

  // The track of the earlier run, in radii of the present top.
  /** @param {number} R in mm */
  trackThen(R) {
    const { before } = this.scene;
    if (!before?.curves[before.table].count) return [];
    const share = before.state.R / R;
    return trackOf(before.frames[before.table], before.unit).map(([t, x, y]) => [t, share * x, share * y]);
  }

  path() {
    const { scene, texts } = this, track = /** @type {number[][]} */ (scene.track(scene.table === "three" ? "ordinary" : scene.table)), { R } = scene.state;
    if (!track.length) return [];
    const kept = thinned(track), then = thinned(this.trackThen(R)), all = [...kept, ...then];
    const bounds = (i) => [Math.min(...all.map((p) => p[i])), Math.max(...all.map((p) => p[i]))];
    const [[x0, x1], [y0, y1]] = [bounds(1), bounds(2)], wide = this.width - 2 * RIGHT, high = this.height - 2 * TOP - FOOT;
    const scale = Math.min(wide / Math.max(x1 - x0, 0.05), high / Math.max(y1 - y0, 0.05));
    const at = (/** @type {number[]} */ [, x, y]) => [this.width / 2 + scale * (x - (x0 + x1) / 2), TOP + high / 2 - scale * (y - (y0 + y1) / 2)];
    const isJump = (line, i) => !i || Math.hypot(line[i][1] - line[i - 1][1], line[i][2] - line[i - 1][2]) > JUMP;
    const pathOf = (line) => line.map((p, i) => `${isJump(line, i) ? "M" : "L"}${at(p).map((v) => v.toFixed(1)).join(" ")}`);
    const points = pathOf(kept);
    if (then.length) {
      this.unnamed = (share) => {
        const [x, y] = at(then[Math.round((1 - share) * (then.length - 1))]); // starting at its end
        return [x + 6, y + 4];
      };
    }
    const { shapes, move } = trail(points);
    this.moves.push((t) => {
      const count = kept.filter(([when]) => when <= t + 1e-9).length;
      move(count, at(kept[Math.max(count - 1, 0)]));
    });
    const mm = ticks(0, (wide * R) / scale, 3)[1], bar = (mm / R) * scale, foot = this.height - 8;
    return [
      ...(then.length ? [drawn("path", { class: "then", d: pathOf(then).join("") })] : []),
      ...shapes,
      drawn("path", { class: "axis", d: `M${RIGHT} ${foot - 5}v5h${bar}v-5` }),
      drawn("text", { x: RIGHT + bar + 8, y: foot + 2 }, say(texts, "{mm} mm", { mm: [mm, mm < 1 ? 1 : 0] })),
    ];
  }

  trace() {
    const { scene, texts, width, height } = this, name = scene.table === "three" ? "ordinary" : scene.table;
    const { lines, move } = caps(texts, { bytes: scene.frames[name], a: scene.a, unit: scene.unit, width, height });
    this.moves.push(move);
    return lines;
  }

  /** @param {number} t */
  at(t) {
    if (!this.width || !this.scene) return;
    dress(this.now, { x1: this.x(t), x2: this.x(t) });
    for (const move of this.moves) move(t);
  }
}

// A selection of the points, always with the last.
/** @param {number[][]} line */
function thinned(line) {
  const step = Math.max(1, Math.ceil(line.length / MOST_POINTS));
  return line.filter((_, i) => i % step === 0 || i === line.length - 1);
}

// The contact point over time: [s, x, y], lengths in R.
/** @param {Bytes} bytes as the frames of a Top3D @param {number} unit s in one unit of time @returns {number[][]} */
export function trackOf(bytes, unit) {
  const frames = new Frames(bytes);
  return Array.from({ length: frames.count }, (_, i) => [unit * frames.time(i), ...frames.contact(i)]);
}
