// The section of the body that is being built: its dimensions as in a technical drawing, and rings that are pulled with
// the hand or the arrow keys. Python says what a ring does there.
import { colours } from "../colours.js";
import { frame } from "../controls/frame.js";
import { coalesce, fill, set, tidy } from "../data.js";
import { clamp } from "../figures/curves.js";
import { hideReadout, showReadout } from "../figures/readout.js";
import { atEnd, onLook } from "../life.js";
import { drawn, dress, fontSize, part } from "../parts.js";

const REACH = { mouse: 16, touch: 26 }, RING = 8; // px
const COLUMN = 30, STEP = 24, HEAD = 7; // px: from the body to the first of the heights, between two of them; of an arrow
const COARSE = 1.15, ALONG = 0.75; // from one scale of the view to the next; where on a slanted line its length is written
const KEYS = { ArrowRight: [0.1, 0], ArrowLeft: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1], PageUp: [0, 1], PageDown: [0, -1] }; // mm
const FAST = 500, FAR = 9999; // ms that a key counts on the one before; mm

/** @typedef {[x: number, z: number]} Point mm, or px of the drawing */
/** @typedef {{ name: string, start: Point, end: Point, at: "left" | "right" | "in" | "out", shown: boolean, says: [string, string] }} Measure */
/** @typedef {{ R: number, com: number, free: boolean, parts: Record<string, Point[][]>, measures: Measure[], handles: Record<string, any[]> }} Section */
/** @typedef {{ scale: number, at: (point: Point) => Point, from: (px: Point) => Point }} View */

const style = `
.frame { --q-wood: color-mix(in srgb, ${colours.wood} 48%, var(--ground)); --q-steel: color-mix(in srgb, var(--ink) 28%, var(--ground)); }
.drawing { height: clamp(320px, 100vh - 400px, 560px); font-size: var(--t-s); user-select: none; -webkit-user-select: none; }
svg { width: 100%; height: 100%; touch-action: pan-y; } svg .word { font-size: 1em; }
.part { stroke: var(--ink); stroke-width: 1.5; stroke-linejoin: round; } .body { fill: url(#wood); } .hollow { fill: var(--ground); } .core { fill: url(#steel); }
.hatch { stroke: color-mix(in srgb, var(--ink) 22%, transparent); } .steel .hatch { stroke: color-mix(in srgb, var(--ink) 60%, transparent); }
.thin { stroke: var(--line-2); fill: none; } .dashed { stroke-dasharray: 3 4; } .middle { stroke-dasharray: 12 4 2 4; } .table { stroke: var(--ink-2); stroke-width: 2; }
.size { stroke: var(--ink-2); } .tip { fill: var(--ink-2); } .held :is(.size, .leg) { stroke: var(--accent); stroke-width: 2; } .held .tip, svg .held .word { fill: var(--accent); }
.dot { fill: var(--ground); stroke: var(--ink); stroke-width: 1.5; } .quarter { fill: var(--ink); }
.grip { outline: none; cursor: grab; } .grip .touch { fill: transparent; } .grip .ring { fill: var(--ground); stroke: var(--ink); stroke-width: 2.5; }
.grip:hover .ring, .grip.held .ring { stroke: var(--accent); } .grip.held .ring { stroke-width: 5; } .grip:focus-visible .ring { stroke: var(--accent); stroke-width: 5; }
.pulls, .pulls .grip { cursor: grabbing; }
`;

// Where the drawing stands: as large as there is room, in coarse steps, so that it does not move with each change.
/** @param {Pick<Section, "R" | "parts">} section @param {{ wide: number, high: number, size: number }} room size: of the type @returns {View} */
export function viewOf({ R, parts }, { wide, high, size }) {
  const body = parts.body[0], low = Math.min(-R, ...body.map(([, z]) => z)), top = Math.max(...body.map(([, z]) => z)), half = Math.max(...body.map(([x]) => x));
  const left = 7 * size, right = 9 * size, above = 2.5 * size, below = 2.5 * size;
  const most = Math.min((wide - left - right) / (2 * half), (high - above - below) / (top - low));
  const scale = COARSE ** Math.floor(Math.log(most) / Math.log(COARSE)), middle = [(left + wide - right) / 2, (above + high - below) / 2 + (scale * (top + low)) / 2];
  return { scale, at: ([x, z]) => [middle[0] + scale * x, middle[1] - scale * z], from: ([x, y]) => [(x - middle[0]) / scale, (middle[1] - y) / scale] };
}

const path = (points) => `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`;
const line = (kind, ...points) => drawn("path", { class: kind, d: path(points) });
const tip = ([x, y], way) => drawn("path", { class: "tip", d: `M${x} ${y}l${-HEAD / 2} ${way * HEAD}h${HEAD}z` });

/** @param {Point} at @param {string[]} lines @param {string} anchor @param {number} size */
const word = ([x, y], lines, anchor, size) => lines.map((text, i) =>
  drawn("text", { class: "word halo", x, y: y + (0.35 + 1.25 * (i - (lines.length - 1) / 2)) * size, "text-anchor": anchor }, text));

// A dimension between its two points; a height has its line beside the body, in the given column.
/** @param {Measure} measure @param {View} view @param {{ edges: [number, number], column: number, size: number, held: string }} place */
function dimension({ name, start, end, at, says }, view, { edges, column, size, held }) {
  const [a, b] = [start, end].map(view.at), kind = `measure${name === held ? " held" : ""}`;
  if (at === "left" || at === "right") {
    const right = at === "right", x = right ? edges[1] + COLUMN + STEP * column : edges[0] - COLUMN, up = Math.sign(b[1] - a[1]) || 1;
    return drawn("g", { class: kind }, line("thin leg", a, [x, a[1]]), line("thin leg", b, [x, b[1]]), line("size", [x, a[1]], [x, b[1]]), tip([x, a[1]], up), tip([x, b[1]], -up),
      ...word([right ? x + 6 : x - 6, (a[1] + b[1]) / 2], says, right ? "start" : "end", size));
  }
  const left = b[0] < a[0], place = /** @type {Point} */ (at === "out" ? [b[0] + (left ? -14 : 14), b[1] - (b[1] < a[1] ? 8 : 0)] : [a[0] + ALONG * (b[0] - a[0]), a[1] + ALONG * (b[1] - a[1])]);
  return drawn("g", { class: kind }, line("size", a, b), ...word(place, [says.join(" ")], at === "in" ? "middle" : left ? "end" : "start", size));
}

/** @param {string} id @param {number} turn */
const hatched = (id, turn) => drawn("pattern", { id, class: id, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: `rotate(${turn})` },
  drawn("rect", { width: 7, height: 7, fill: `var(--q-${id})` }), drawn("path", { class: "hatch", d: "M0 0V7" }));

// All but the rings.
/** @param {Section} section @param {View} view @param {{ texts: Record<string, any>, wide: number, size: number, held: string }} given */
function picture({ R, com, parts, measures }, view, { texts, wide, size, held }) {
  const { at, scale } = view, body = parts.body[0], half = Math.max(...body.map(([x]) => x)), top = Math.max(...body.map(([, z]) => z));
  const [O, C, G, head] = [[0, 0], [0, -R], [0, com], [0, top]].map(/** @type {any} */ (at)), edges = /** @type {[number, number]} */ ([at([-half, 0])[0], at([half, 0])[0]]);
  const outline = (points) => `${path([...points.map(at), ...points.map(([x, z]) => at([-x, z])).reverse()])}Z`;
  const shown = measures.filter((each) => each.shown || each.name === held), heights = shown.filter((each) => each.at === "right");
  const below = fill(texts[com > 0 ? "above" : "below"], { mm: tidy(Math.abs(com)) });
  return [
    drawn("defs", {}, hatched("wood", 45), hatched("steel", -45)), line("table", [0.5 * size, C[1]], [wide - 0.5 * size, C[1]]),
    ...Object.entries(parts).flatMap(([kind, outlines]) => outlines.map((points) => drawn("path", { class: `part ${kind}`, d: outline(points) }))),
    drawn("circle", { class: "thin dashed", cx: O[0], cy: O[1], r: R * scale }), line("thin middle", [C[0], C[1] + size], [head[0], head[1] - size]),
    ...shown.map((each) => dimension(each, view, { edges, column: heights.indexOf(each) % 2, size, held })),
    drawn("circle", { class: "dot", cx: O[0], cy: O[1], r: 3 }), ...word([O[0] - 10, O[1] - size], ["O"], "end", size),
    drawn("circle", { class: "dot", cx: G[0], cy: G[1], r: 6 }), drawn("path", { class: "quarter", d: `M${G[0]} ${G[1]}v-6a6 6 0 0 1 6 6zv6a6 6 0 0 1 -6 -6z` }),
    ...word([G[0] + 14, G[1] + size], [below], "start", size),
  ];
}

class Bench {
  /** @param {Rendering<SectionModel>} rendering */
  constructor(rendering) {
    const { model } = rendering;
    this.model = model;
    this.held = "";
    this.off = [0, 0]; // mm, from the hand to the ring
    /** @type {any} */
    this.state = null; // a Section, once there is one
    /** @type {any} */
    this.view = null;
    /** @type {Record<string, any>} */
    this.keyed = { when: -Infinity };
    this.layer = drawn("g");
    this.grips = drawn("g");
    this.svg = drawn("svg", { role: "group", "aria-label": model.texts.label }, this.layer, this.grips);
    const life = frame(rendering, style, part("div", { class: "drawing", "data-figure": "section" }, this.svg));
    this.update = coalesce(() => this.show(), life);
    new ResizeObserver(this.update).observe(this.svg);
    onLook(this.update, life);
    model.on("state", this.update);
    atEnd(life, () => hideReadout(this));
    this.listen();
  }

  listen() {
    const { svg } = this, near = ({ clientX, clientY }) => this.near(this.pointOf({ clientX, clientY }), REACH.touch);
    svg.addEventListener("touchstart", (event) => event.touches.length === 1 && near(event.touches[0]) && event.preventDefault(), { passive: false }); // anywhere else it scrolls the page
    svg.onpointerdown = (event) => this.take(event);
    svg.onpointermove = (event) => this.move(event);
    svg.onpointerup = svg.onpointercancel = () => this.release();
    svg.onpointerleave = () => this.held || hideReadout(this);
    svg.ondblclick = (event) => this.twice(event);
    svg.onkeydown = (event) => this.key(event);
  }

  /** @returns {Point} */
  pointOf({ clientX, clientY }) {
    const { left, top } = this.svg.getBoundingClientRect();
    return [clientX - left, clientY - top];
  }

  // The name of the nearest ring that is within reach.
  near([x, y], reach) {
    const away = (name, [across, z]) => ({ name, far: Math.hypot(...this.view.at([across, z]).map((px, i) => px - [x, y][i])) });
    const [first] = Object.entries(this.state?.handles ?? {}).map(([name, at]) => away(name, at)).sort((a, b) => a.far - b.far);
    return first && first.far < reach ? first.name : "";
  }

  show() {
    const { svg, model } = this, { clientWidth: wide, clientHeight: high } = svg;
    /** @type {Section} */
    const state = JSON.parse(model.state);
    if (!wide || !high || !state.parts) return;
    const size = fontSize(svg);
    this.state = state;
    if (!this.held || !this.view) this.view = viewOf(state, { wide, high, size });
    svg.setAttribute("viewBox", `0 0 ${wide} ${high}`);
    this.layer.replaceChildren(...picture(state, this.view, { texts: model.texts, wide, size, held: this.held }));
    this.showGrips(state.handles);
  }

  // The rings stay the same elements, so that one keeps the focus.
  showGrips(handles) {
    const names = Object.keys(handles), now = [...this.grips.children];
    if (names.join() !== now.map((grip) => grip.dataset.name).join())
      this.grips.replaceChildren(...names.map((name) => drawn("g", { class: "grip", role: "slider", tabindex: 0, "data-name": name },
        drawn("circle", { class: "touch", r: 2 * RING }), drawn("circle", { class: "ring", r: RING }))));
    for (const grip of this.grips.children) {
      const [x, z, [label, text], value, low, high] = handles[grip.dataset.name], [px, py] = this.view.at([x, z]);
      dress(grip, { "aria-label": label, "aria-valuetext": text, "aria-valuenow": value, "aria-valuemin": Math.min(low, value), "aria-valuemax": Math.max(high, value),
        transform: `translate(${px.toFixed(1)} ${py.toFixed(1)})` });
      grip.classList.toggle("held", grip.dataset.name === this.held);
    }
  }

  take(event) {
    const point = this.pointOf(event), name = event.button ? "" : this.near(point, REACH[event.pointerType] ?? REACH.mouse);
    if (!name) return;
    const [x, z] = this.state.handles[name], [px, pz] = this.view.from(point);
    this.held = name;
    this.off = [x - px, z - pz]; // the ring stays where it was grabbed
    this.svg.setPointerCapture(event.pointerId);
    this.svg.classList.add("pulls");
    this.show();
  }

  move(event) {
    const point = this.pointOf(event), name = this.held || this.near(point, REACH.mouse);
    if (this.held) this.ask(this.held, this.view.from(point).map((mm, i) => mm + this.off[i]));
    if (!name) return hideReadout(this);
    const [, , wording] = this.state.handles[name] ?? [0, 0, []];
    showReadout(this, wording.filter(Boolean).join(": "), [event.clientX, event.clientY], []);
  }

  release() {
    if (!this.held) return;
    this.held = "";
    this.svg.classList.remove("pulls");
    hideReadout(this);
    this.show();
  }

  ask(name, place) {
    set(this.model, "hand", [name, clamp(place[0], -FAR, FAR), clamp(place[1], -FAR, FAR)]);
  }

  twice(event) {
    if (!this.state?.free) return;
    const point = this.pointOf(event), [x, z] = this.view.from(point), [count = 0] = this.model.tapped;
    set(this.model, "tapped", [count + 1, this.near(point, REACH.mouse), x, z]);
  }

  key(event) {
    const name = event.target.closest?.(".grip")?.dataset.name, by = KEYS[event.key];
    if (!name || !by || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const goesOn = this.keyed.name === name && event.timeStamp - this.keyed.when < FAST, from = goesOn ? this.keyed.place : this.state.handles[name];
    const place = [from[0] + by[0], from[1] + by[1]];
    this.keyed = { name, place, when: event.timeStamp };
    this.ask(name, place);
  }
}

/** @param {Rendering<SectionModel>} rendering */
export const renderSection = (rendering) => void new Bench(rendering);
