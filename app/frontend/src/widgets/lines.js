// The lines of the derivation: each equation, the present values of its two sides, and the symbols that can be pointed
// at.
import { local, rowBefore } from "../data.js";
import { followClock } from "../figures/seeking.js";
import { atEnd, lifeOf } from "../life.js";
import { style } from "./lines_style.js";
import { part, typeset } from "../parts.js";

const DRAWN_MS = 200; // ms between two updates of the numbers

// Writes numbers with `digits` significant digits; the rounding error of an exact zero is not shown.
/** @param {number} value @param {number} digits */
export function figures(value, digits) {
  if (!Number.isFinite(value)) return "—";
  const size = Math.abs(value);
  const text = size < 1e-300 ? 0 : size < 1e-4 ? value.toExponential(digits > 6 ? 3 : 1) : Number(value.toPrecision(digits));
  return local(String(text));
}

/** @param {Float64Array} side @param {number} digits */
export const wording = (side, digits) =>
  side.length === 1 ? figures(side[0], digits) : `(${Array.from(side, (x) => figures(x, 6)).join("; ")})`;

// The row closest to a time within its nutation; t is the first number of each row.
/** @param {{ values: Float64Array, width: number, period: number }} table @param {number} now */
export function rowAt({ values, width, period }, now) {
  const t = now - Math.floor(now / period) * period, low = rowBefore(values, t, width), high = low + 1;
  const row = t - values[low * width] <= values[high * width] - t ? low : high;
  return values.subarray(row * width, (row + 1) * width);
}

// The browser's rendering of an equation contains other characters, and invisible spaces.
const bare = (node) => node.textContent.replace(/[\s\u2061\u200b\u2062]/g, "").replace("\u20d7", "→");

class Lines {
  /** @param {LinesModel} model */
  constructor(model, el) {
    this.model = model;
    this.tip = part("div", { class: "tip", hidden: true });
    this.now = this.shown = 0;
    /** @type {{ name: string, plane: string, anchor: HTMLElement } | null} */
    this.pointed = null;
    /** @type {Record<string, { values: Float64Array, width: number, period: number }>} */
    this.tables = {};
    this.read();
    this.rows = model.lines.map((line) => this.line(line));
    this.root = part("div", { class: "lines" }, part("style", {}, style), ...this.rows.map(({ box }) => box), this.tip);
    el.append(this.root);
    this.draw();
  }

  read() {
    const { model } = this;
    ["rough", "smooth"].forEach((plane, i) => {
      const bytes = model[plane], buffer = bytes instanceof ArrayBuffer ? bytes : bytes.slice().buffer;
      this.tables[plane] = { values: new Float64Array(buffer), width: model.widths[i], period: model.periods[i] };
    });
  }

  row(plane) { return rowAt(this.tables[plane], this.now); }

  valueOf(name, plane) {
    const { at, size } = this.model.symbols[name];
    return wording(this.row(plane).subarray(at, at + size), 6);
  }

  point(name, plane, anchor) {
    this.pointed = name && { name, plane, anchor };
    this.tell();
  }

  // Shows the meaning beside the symbol, and sends it to the pictures that have an arrow for it.
  tell() {
    const { pointed, tip, model } = this;
    /** @type {Pointed | null} */
    let detail = null;
    tip.hidden = !pointed;
    if (pointed) {
      const { name, plane, anchor } = pointed, { arrow, start, says, label } = model.symbols[name];
      tip.textContent = `${says}, ${model.words.now} ${this.valueOf(name, plane)}`;
      const box = anchor.getBoundingClientRect();
      tip.style.left = `${Math.max(4, Math.min(box.left, innerWidth - 290))}px`;
      tip.style.top = `${box.bottom + 6}px`;
      if (arrow >= 0 && plane === "rough") {
        const [x, y, z] = this.row(plane).subarray(arrow, arrow + 3);
        detail = { vector: [x, y, z], start, label };
      }
    }
    window.dispatchEvent(new CustomEvent(`tippe:highlight:${model.clock}`, { detail }));
  }

  line(line) {
    const { words } = this.model, eq = typeset(line.tex, { class: "eq", role: "group", "aria-label": `${words.equation} ${line.number}` });
    this.mark(line, eq);
    const entries = line.symbols.map((name) => [name, this.entry(line, name)]);
    const sides = part("div", { class: "sides", "data-line": line.number }), list = part("div", { class: "symbols", hidden: true }, ...entries.map(([, entry]) => entry));
    const button = part("button", { "aria-expanded": "false", "aria-label": `${line.number}: ${words.symbols}`, onclick: () => {
      list.hidden = !list.hidden;
      button.setAttribute("aria-expanded", String(!list.hidden));
      this.draw();
    } }, line.number);
    const box = part("div", { class: "line" }, part("div", { class: "head" }, button, eq), part("div", {}, line.words), sides, list);
    return { line, box, sides, list, entries };
  }

  // The symbols in an equation that can be pointed at.
  mark(line, eq) {
    const marked = new Set();
    for (const node of eq.querySelectorAll("semantics > mrow *")) {
      if ([...marked].some((outer) => outer.contains(node))) continue;
      const text = bare(node), name = line.symbols.find((symbol) => [...this.model.symbols[symbol].texts].includes(text));
      if (!name) continue;
      marked.add(node);
      node.classList.add("known");
      node.dataset.symbol = name;
      node.addEventListener("pointerenter", () => this.point(name, line.plane, node));
      node.addEventListener("pointerleave", () => this.point(null));
    }
  }

  entry(line, name) {
    const on = () => this.point(name, line.plane, entry), off = () => this.point(null);
    const entry = part("div", { tabindex: 0, role: "note", onpointerenter: on, onfocus: on, onpointerleave: off, onblur: off });
    return entry;
  }

  draw() {
    const { words, symbols } = this.model;
    for (const { line, sides, list, entries } of this.rows) {
      const values = this.row(line.plane), { at, size, scale } = line;
      const left = values.subarray(at, at + size), right = values.subarray(at + size, at + 2 * size);
      const apart = Math.max(...left.map((x, i) => Math.abs(x - right[i]))) / scale;
      const all = [[words.left, wording(left, 10)], [words.right, wording(right, 10)], [words.differ, figures(apart, 2)]];
      sides.replaceChildren(...all.flatMap(([word, text]) => [`${word} `, part("b", {}, text), "  "]));
      sides.dataset.apart = apart;
      if (list.hidden) continue;
      for (const [name, entry] of entries) {
        const { label, says } = symbols[name];
        entry.textContent = `${label}: ${says}, ${this.valueOf(name, line.plane)}`;
      }
    }
    if (this.pointed) this.tell();
  }

  // With a delay, so that the last moment before a pause is shown too.
  tick({ t }) {
    this.now = t;
    this.due ??= setTimeout(() => {
      this.due = undefined;
      this.shown = performance.now();
      if (this.root.isConnected && this.root.offsetParent) this.draw();
    }, Math.max(0, DRAWN_MS - (performance.now() - this.shown)));
  }
}

/** @param {Rendering<LinesModel>} rendering */
export function renderLines({ model, el }) {
  const lines = new Lines(model, el), life = lifeOf({ model });
  model.on("periods", () => { // the last of the parameters that are sent together
    lines.read();
    lines.draw();
  });
  followClock((moment) => lines.tick(moment), model.clock, life);
  atEnd(life, () => clearTimeout(lines.due));
}
