// For three tables: what each of them conserves, from the start to the present moment. Python says how far.
import { float32, rowBefore } from "../data.js";
import { TABLES } from "../motion/curves.js";
import { drawn, part, say, written } from "../parts.js";

const KINDS = ["kept", "swings", "nearly", "zero", "lost", "gripped"]; // as in app/model/keeps.py
const OWN = { energy: { lost: "heat" }, spin: { zero: "reversed" } }; // a quantity's own word
const DIGITS = { energy: 0, jellett: 2, routh: 2, spin: 1 }, MOST_DIGITS = 5;
const WIDTH = 1 + 3 * Object.keys(DIGITS).length;
const ROUNDED = 1e-6; // s: times are float32

const RING = { cx: 7, cy: 7, r: 5.25, fill: "none", stroke: "currentColor", "stroke-width": 1.5 };
const full = () => [drawn("circle", { cx: 7, cy: 7, r: 6, fill: "currentColor" })];
const half = () => [drawn("circle", RING), drawn("path", { d: "M7 1a6 6 0 0 1 0 12z", fill: "currentColor" })];
const empty = () => [drawn("circle", RING)];
const MARKS = { kept: full, swings: half, nearly: half, zero: empty, lost: empty, gripped: empty };

// Each quantity at a time: how far it is conserved, and that in words and in numbers.
/** @param {Float32Array} rows @param {number} t @param {Record<string, any>} texts @returns {[kind: string, word: string, numbers: string][]} */
export function keptAt(rows, t, texts) {
  const last = rows.length / WIDTH - 1, i = t + ROUNDED >= rows[last * WIDTH] ? last : rowBefore(rows, t + ROUNDED, WIDTH);
  return Object.entries(DIGITS).map(([name, digits], k) => {
    const [code, ...numbers] = rows.subarray(i * WIDTH + 1 + 3 * k, i * WIDTH + 4 + 3 * k), kind = KINDS[code];
    return [kind, texts.keep[OWN[name]?.[kind] ?? kind], numbersOf(kind, numbers, digits, texts, texts.keep.units[k])];
  });
}

// With as many digits as are needed to tell the two apart.
/** @param {string} kind @param {number[]} numbers @param {number} least @param {Record<string, any>} texts @param {string} unit */
function numbersOf(kind, [first, last], least, texts, unit) {
  const form = texts.keep[kind === "kept" ? "one" : kind === "swings" ? "range" : "two"];
  const isSame = (count) => written(first, count, texts.decimal) === written(last, count, texts.decimal);
  let digits = least;
  if (kind !== "kept") while (digits < MOST_DIGITS && isSame(digits)) digits += 1;
  return say(texts, form, { first: [first, digits], last: [last, digits], unit });
}

export class Keeps {
  /** @param {Record<string, any>} texts */
  constructor(texts) {
    this.texts = texts;
    this.body = part("tbody");
    this.until = part("span", { class: "small" });
    this.pushes = /** @type {number[]} */ ([]); // their times, s
    this.element = part("section", { class: "keeps", tabindex: 0, "aria-label": texts.keeps }, // scrolls on a phone
      part("div", { class: "titled" }, part("h2", {}, texts.keeps), part("span", { class: "half" }, texts.keep.half), this.until),
      part("table", {}, part("thead", {}, part("tr", {}, part("td"), ...texts.kept.map((word) => part("th", { scope: "col" }, word)))), this.body));
  }

  show(scene) {
    const { texts } = this;
    this.pushes = Object.values(scene.runs).flatMap((run) => run?.events ?? []).flatMap(([at, code]) => (code === "push" ? [at] : []));
    this.tables = scene.table === "three" ? TABLES.map((name) => {
      const rows = float32(scene.keeps[name]);
      const cells = texts.kept.map(() => ({ mark: drawn("svg", { viewBox: "0 0 14 14", width: 14, height: 14, "aria-hidden": "true" }), word: part("span"), numbers: part("span", { class: "small" }), kind: "" }));
      const columns = rows.length ? cells.map(({ mark, word, numbers }) => part("td", {}, part("span", { class: "kept" }, mark, word), numbers))
        : [part("td", { colspan: cells.length }, scene.runs[name]?.why ?? "")];
      if (rows.length && scene.runs[name]?.jellett) columns[1].append(part("p", { class: "small" }, scene.runs[name].jellett));
      return { rows, cells, row: part("tr", {}, part("th", { scope: "row" }, texts.tables[name]), ...columns) };
    }) : [];
    this.body.replaceChildren(...this.tables.map(({ row }) => row));
  }

  /** @param {number} t */
  at(t) {
    const { texts, tables = [] } = this;
    if (!tables.length) return;
    const since = Math.max(0, ...this.pushes.filter((push) => push <= t + ROUNDED)); // of the last push
    this.until.textContent = say(texts, texts.span, { from: [since, since ? 2 : 0], t: [t, 2] });
    for (const { rows, cells } of tables) {
      if (!rows.length) continue;
      keptAt(rows, t, texts).forEach(([kind, word, numbers], k) => {
        const cell = cells[k];
        if (cell.kind !== kind) cell.mark.replaceChildren(...MARKS[(cell.kind = kind)]());
        cell.word.textContent = word;
        cell.numbers.textContent = numbers;
      });
    }
  }
}
