// The numbers of the present moment, in a fold.
import { ENERGY, HEAT, HEIGHT, SPIN, TIME, TURNING, TILT } from "./curves.js";
import { part, say } from "./parts.js";

/** @type {[name: string, column: number, digits: number][]} */
const ROWS = [["t", TIME, 2], ["tilt", TILT, 1], ["height", HEIGHT, 1], ["energy", ENERGY, 1], ["heat", HEAT, 1], ["spin", SPIN, 1], ["turning", TURNING, 1]];

export class Numbers {
  /** @param {Record<string, any>} texts */
  constructor(texts) {
    this.texts = texts;
    this.cells = ROWS.map(() => part("td"));
    this.element = part("details", { class: "numbers", ontoggle: () => this.at(this.t ?? 0) }, part("summary", {}, texts.numbers),
      part("table", {}, part("tbody", {}, ...ROWS.map(([name], i) => part("tr", {}, part("th", { scope: "row" }, texts.number[name][0]), this.cells[i])))));
  }

  show(scene) {
    this.curves = scene.curves[scene.table === "three" ? "ordinary" : scene.table];
  }

  /** @param {number} t */
  at(t) {
    this.t = t;
    if (!this.element.open || !this.curves?.count) return;
    ROWS.forEach(([name, column, digits], i) => {
      this.cells[i].textContent = said(this.texts, this.curves, name, column, digits, t);
    });
  }
}

// A quantity at a time, with its unit.
const said = (texts, curves, name, column, digits, t) =>
  say(texts, `{value}${texts.number[name][1]}`, { value: [column === TIME ? t : curves.at(t, column), digits] });

// Some of them in one line, to be shown at the pointer.
/** @param {Record<string, any>} texts @param {import("./curves.js").Curves} curves @param {string[]} names @param {number} t */
export const lineOf = (texts, curves, names, t) => ROWS.filter(([name]) => name === "t" || names.includes(name))
  .map(([name, column, digits]) => `${name === "t" ? "" : `${texts.number[name][0]} `}${said(texts, curves, name, column, digits, t)}`).join(" · ");
