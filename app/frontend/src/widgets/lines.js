// The lines of the derivation: each equation, the present values of its two sides, and the symbols that can be pointed
// at.
import { local, rowBefore } from "../data.js";
import { style } from "./lines_style.js";

const DRAWN_MS = 200; // ms between two updates of the numbers

// Writes numbers with `digits` significant digits; the rounding error of an exact zero is not shown.
/** @param {number} value @param {number} digits */
export function figures(value, digits) {
  if (!Number.isFinite(value)) return "—";
  const size = Math.abs(value);
  const text = size < 1e-300 ? 0 : size < 1e-4 ? value.toExponential(digits > 6 ? 3 : 1) : Number(value.toPrecision(digits));
  return local(String(text));
}

/** @param {Float64Array} part @param {number} digits */
export const said = (part, digits) =>
  part.length === 1 ? figures(part[0], digits) : `(${Array.from(part, (x) => figures(x, 6)).join("; ")})`;

// The row closest to a time within its nutation; t is the first number of each row.
/** @param {{ values: Float64Array, width: number, period: number }} table @param {number} now */
export function rowAt({ values, width, period }, now) {
  const t = now - Math.floor(now / period) * period, low = rowBefore(values, t, width), high = low + 1;
  const row = t - values[low * width] <= values[high * width] - t ? low : high;
  return values.subarray(row * width, (row + 1) * width);
}

// The browser's rendering of an equation contains other characters, and invisible spaces.
const bare = (node) => node.textContent.replace(/[\s\u2061\u200b\u2062]/g, "").replace("\u20d7", "→");

function make(parent, kind, name = "", text = "") {
  const node = document.createElement(kind);
  if (name) node.className = name;
  node.textContent = text;
  parent.append(node);
  return node;
}

class Lines {
  /** @param {LinesModel} model */
  constructor(model, el) {
    this.model = model;
    this.root = document.createElement("div");
    this.root.className = "lines";
    make(this.root, "style", "", style);
    this.tip = document.createElement("div");
    this.tip.className = "tip";
    this.tip.hidden = true;
    this.now = this.shown = 0;
    /** @type {{ name: string, plane: string, anchor: HTMLElement } | null} */
    this.pointed = null;
    /** @type {Record<string, { values: Float64Array, width: number, period: number }>} */
    this.tables = {};
    this.read();
    this.rows = model.lines.map((line) => this.line(line));
    this.root.append(this.tip);
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

  row(plane) {
    return rowAt(this.tables[plane], this.now);
  }

  valueOf(name, plane) {
    const { at, size } = this.model.symbols[name];
    return said(this.row(plane).subarray(at, at + size), 6);
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
    const { words } = this.model, box = make(this.root, "div", "line"), head = make(box, "div", "head");
    const button = make(head, "button", "", line.number), eq = make(head, "div", "eq");
    button.setAttribute("aria-expanded", "false");
    button.setAttribute("aria-label", `${line.number}: ${words.symbols}`);
    eq.tabIndex = 0; // so that it can be scrolled by keyboard
    eq.setAttribute("role", "group");
    eq.setAttribute("aria-label", `${words.equation} ${line.number}`);
    if (window.katex) window.katex.render(`\\displaystyle ${line.tex}`, eq, { output: "mathml", throwOnError: false });
    else eq.textContent = line.tex;
    this.mark(line, eq);
    make(box, "div", "", line.words);
    const sides = make(box, "div", "sides"), list = make(box, "div", "symbols");
    sides.dataset.line = line.number;
    list.hidden = true;
    const entries = line.symbols.map((name) => [name, this.entry(line, name, list)]);
    button.addEventListener("click", () => {
      list.hidden = !list.hidden;
      button.setAttribute("aria-expanded", String(!list.hidden));
      this.draw();
    });
    return { line, sides, list, entries };
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

  entry(line, name, list) {
    const entry = make(list, "div");
    entry.tabIndex = 0;
    entry.setAttribute("role", "note");
    for (const [on, off] of [["pointerenter", "pointerleave"], ["focus", "blur"]]) {
      entry.addEventListener(on, () => this.point(name, line.plane, entry));
      entry.addEventListener(off, () => this.point(null));
    }
    return entry;
  }

  draw() {
    const { words, symbols } = this.model;
    for (const { line, sides, list, entries } of this.rows) {
      const values = this.row(line.plane), { at, size, scale } = line;
      const left = values.subarray(at, at + size), right = values.subarray(at + size, at + 2 * size);
      const apart = Math.max(...left.map((x, i) => Math.abs(x - right[i]))) / scale;
      sides.replaceChildren();
      for (const [word, text] of [[words.left, said(left, 10)], [words.right, said(right, 10)], [words.differ, figures(apart, 2)]]) {
        sides.append(`${word} `);
        make(sides, "b", "", text);
        sides.append("  ");
      }
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
  tick(t) {
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
  const lines = new Lines(model, el), onClock = ({ detail: { t } }) => lines.tick(t);
  model.on("periods", () => { // the last of the parameters that are sent together
    lines.read();
    lines.draw();
  });
  window.addEventListener(`tippe:clock:${model.clock}`, onClock);
  model.on("remove", () => {
    clearTimeout(lines.due);
    window.removeEventListener(`tippe:clock:${model.clock}`, onClock);
  });
}
