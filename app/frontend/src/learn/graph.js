// The picture of a step: curves as far as they have been seen, or the section with the two lever arms of a push.
import { onBoth } from "../colours.js";
import { digitsOf, ENERGY, HEIGHT, SPIN, TIME, ticks, TURNING } from "../motion/curves.js";
import { levels, marks as marksOf, times } from "../figures/line.js";
import { drawn, dress, part, say } from "../parts.js";
import { float32 } from "../data.js";
import { Arms } from "./arms.js";

const LEFT = 46, RIGHT = 12, TOP = 10, FOOT = 22, APART = 15, CLOSE = 24, LETTER = 6; // px

// Words beside points of a drawing, pushed apart where they would overlap.
/** @template {{ y: number }} T @param {T[]} words @param {number} least @param {number} most */
export function apart(words, least, most) {
  const sorted = [...words].sort((one, other) => one.y - other.y);
  sorted.forEach((word, i) => (word.y = Math.max(word.y, i ? sorted[i - 1].y + APART : least)));
  for (let i = sorted.length - 1, room = most; i >= 0; i--, room -= APART) sorted[i].y = Math.min(sorted[i].y, room);
  return words;
}

/** @param {import("../motion/curves.js").Curves} curves @param {number} column @param {number} end */
function columnOf(curves, column, end) {
  const found = [];
  for (let i = 0; i < curves.count && curves.value(i, TIME) <= end + 1e-6; i++) found.push([curves.value(i, TIME), curves.value(i, column)]);
  return found;
}

export class Graph {
  /** @param {Record<string, any>} texts */
  constructor(texts) {
    this.texts = texts;
    this.width = this.height = 0; // px; not known yet
    this.t = 0;
    this.scale = { x: (value) => value, y: (value) => value, time: false, clip: /** @type {any} */ (null), bottom: 0, right: 0 };
    /** @type {any[]} */
    this.words = [];
    this.arms = new Arms(texts.drawn.arms);
    this.title = part("h3");
    this.drawing = drawn("svg", { role: "img" });
    this.plot = part("div", { class: "plot" }, this.drawing);
    this.below = part("p", { class: "axis-name" });
    this.element = part("section", { class: "picture" }, this.title, this.plot, this.below);
    new ResizeObserver(() => this.draw()).observe(this.plot);
  }

  show(scene) {
    this.scene = scene;
    const { step, record, tops } = scene;
    // what gives the answer away is drawn only after the guess
    this.kind = step.picture === "arms" && record.requested ? "graph" : step.picture;
    if (["curves", "heads"].includes(step.picture)) this.kind = record.requested ? "graph" : "";
    this.element.hidden = !this.kind || !tops.length;
    this.draw();
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.plot, { scene, texts } = this;
    if (!width || !scene || this.element.hidden) return;
    Object.assign(this, { width, height });
    const { step } = scene, wording = texts.drawn[step.picture];
    this.drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.title.innerHTML = this.kind === "graph" ? step.graph.y : wording.title;
    this.drawing.setAttribute("aria-label", this.title.textContent);
    this.below.innerHTML = this.kind === "graph" ? step.graph.x : "";
    if (this.kind === "arms") this.drawing.replaceChildren(...this.arms.draw(scene.tops[0].run, width, height));
    else this.drawing.replaceChildren(...this.lines(this.kind === "graph" ? this.graph() : this[this.kind](wording)));
    this.at(this.t);
  }

  spin(wording) {
    const { scene: { step, curves: [curves] } } = this;
    return { time: true, unit: "", lines: [
      { word: wording.above, kind: "turning", points: columnOf(curves, TURNING, step.end), dash: "7 4" },
      { word: wording.own, kind: "own", points: columnOf(curves, SPIN, step.end) }], marks: [], zero: true };
  }

  energy(wording) {
    const { scene: { step, curves: [curves] } } = this, whole = columnOf(curves, ENERGY, step.end), first = whole[0][1];
    return { time: true, unit: "mm", zero: true, marks: [], lines: [
      { word: wording.heat, kind: "first", points: whole.map(([t]) => [t, first]), dash: "4 3", below: true },
      { word: wording.spin, kind: "energy", points: whole, fill: "spins", below: true },
      { word: wording.height, kind: "energy", points: columnOf(curves, HEIGHT, step.end), fill: "lifts", above: true }] };
  }

  graph() {
    const { graph } = this.scene.step;
    const lines = graph.curves.map(({ word, key, colour, dash, x, y }) => {
      const [xs, ys] = [float32(x), float32(y)];
      return { word: key === "zero" ? "" : word, colour: onBoth(colour), dash: { dashed: "7 4", dotted: "2 4" }[dash], points: Array.from(xs, (value, i) => [value, ys[i]]) };
    });
    return { time: graph.of === "t", unit: "", lines, marks: graph.points, zero: false };
  }

  // The frame, the curves, and their names at their ends.
  lines({ time, unit, lines, marks, zero }) {
    const { width, height, texts, scene: { step } } = this, bottom = height - FOOT, right = width - RIGHT;
    const all = [...lines.flatMap(({ points }) => points), ...marks.map(([, x, y]) => [x, y])].filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y));
    const span = (i) => [Math.min(...all.map((point) => point[i])), Math.max(...all.map((point) => point[i]))];
    const [x0, x1] = time ? [0, step.end] : span(0), [low, high] = span(1), pad = 0.08 * (high - low || 1);
    const [y0, y1] = [zero ? Math.min(low - (low < 0 ? 2 * pad : 0), 0) : low - 2 * pad, high + pad]; // room for words below, too
    const x = (value) => LEFT + ((right - LEFT) * (value - x0)) / (x1 - x0 || 1), y = (value) => bottom - ((bottom - TOP) * (value - y0)) / (y1 - y0);
    const marked = ticks(y0, y1, Math.max(2, height / 60)), places = digitsOf(marked), along = ticks(x0, x1, width / 80), sides = digitsOf(along);
    const number = (value) => say(texts, value === marked.at(-1) && unit ? `{value} ${unit}` : "{value}", { value: [value, places] });
    const found = [...levels(marked, { y, left: LEFT, right }, number),
      ...marksOf(along, { x, bottom }, time ? times(texts, sides) : (value) => say(texts, "{value}", { value: [value, value ? sides : 0] }))];
    const clip = drawn("rect", { x: 0, y: 0, width, height });
    const of = (points) => points.map((point, i) => (point.every(Number.isFinite) ? `${i && points[i - 1].every(Number.isFinite) ? "L" : "M"}${x(point[0]).toFixed(1)} ${y(point[1]).toFixed(1)}` : "")).join("");
    const paths = lines.flatMap(({ points, kind, colour, dash, fill }) => [
      ...(fill ? [drawn("path", { class: fill, d: `${of(points)}L${x(points.at(-1)[0])} ${y(0)}L${x(points[0][0])} ${y(0)}Z` })] : []),
      drawn("path", { class: `line ${kind ?? ""}`, d: of(points), stroke: colour, "stroke-dasharray": dash })]);
    found.push(drawn("clipPath", { id: "lesson-graph" }, clip), drawn("g", { "clip-path": "url(#lesson-graph)" }, ...paths));
    this.covering = drawn("rect", { class: "covered", y: TOP - 8, height: bottom - TOP + 8, width: 0 });
    this.now = drawn("line", { class: "now", y1: TOP - 8, y2: bottom });
    if (time) found.push(this.covering, this.now);
    for (const [, px, py] of marks) found.push(drawn("circle", { class: "mark", cx: x(px), cy: y(py), r: 5 }));
    this.words = [...lines.map((line) => ({ ...line, at: time ? null : line.points.findLast((point) => point.every(Number.isFinite)) })), ...marks.map(([word, px, py]) => ({ word, at: [px, py], points: [] }))]
      .filter(({ word }) => word).map((word) => ({ ...word, element: drawn("text", { class: `word halo ${word.kind ?? ""}`, style: word.colour && `fill: ${word.colour}` }, word.word) }));
    this.scale = { x, y, time, clip, bottom, right };
    return [...found, ...this.words.map(({ element }) => element)];
  }

  // Places the words beside what has been seen last.
  place(seen) {
    const { x, y, bottom, right } = this.scale, middle = (LEFT + right) / 2;
    const found = this.words.map((word) => {
      const point = word.at ?? word.points.findLast(([t]) => t <= seen + 1e-6) ?? word.points[0], px = x(point[0]);
      const py = y(point[1]);
      const falls = px >= middle && !word.above && this.heightBefore(word, px) < py - 2;
      return { word, px, py, y: py + (word.below || falls ? 16 : word.above || px >= middle ? -8 : 4) };
    });
    // of two curves that end close together, the lower one has its name below
    const ends = found.filter(({ word, px }) => px >= middle && !word.below && !word.above).sort((one, other) => one.py - other.py);
    ends.forEach((end, i) => i && end.py - ends[i - 1].py < CLOSE && ends[i - 1].y < ends[i - 1].py && (end.y = end.py + 16));
    for (const { word, px, y: py } of apart(found, TOP + 8, bottom - 6)) {
      const after = px < middle;
      dress(word.element, { x: after ? px + 8 : px - 8, y: py, "text-anchor": after ? "start" : "end" });
    }
  }

  // The y, in px, at which a curve passes a word that is placed before its end.
  /** @param {any} word @param {number} end */
  heightBefore({ points, word }, end) {
    const { x, y } = this.scale, before = points.filter(([t]) => x(t) <= end - LETTER * word.length);
    return before.length ? y(before.at(-1)[1]) : Infinity;
  }

  /** @param {number} t */
  at(t) {
    const { scene } = this;
    this.t = t;
    if (!this.width || !scene || this.element.hidden) return;
    if (this.kind === "arms") return this.arms.at(scene.curves[0].row(t));
    const { x, time, clip, right } = this.scale, seen = scene.record.seen, end = scene.step.end;
    if (time) {
      const to = x(Math.min(seen, end)), now = x(Math.min(t, end));
      dress(clip, { width: to });
      dress(this.covering, { x: to, width: Math.max(right - to, 0) });
      dress(this.now, { x1: now, x2: now });
    }
    this.place(time ? seen : Infinity);
  }
}
