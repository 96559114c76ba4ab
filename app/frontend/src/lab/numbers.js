// The numbers of the present moment, in a fold.
import { ENERGY, HEAT, HEIGHT, SPIN, TIME, TURNING, TILT } from "../motion/curves.js";
import { part, say } from "../parts.js";

/** @type {[name: string, column: number, digits: number][]} */
const ROWS = [["t", TIME, 2], ["tilt", TILT, 1], ["height", HEIGHT, 1], ["energy", ENERGY, 1], ["heat", HEAT, 1], ["spin", SPIN, 1], ["turning", TURNING, 1]];

/** @param {Record<string, any>} texts */
export function numbersOf(texts) {
  const cells = ROWS.map(() => part("td"));
  let curves = /** @type {any} */ (null), now = 0;
  const at = (/** @type {number} */ t) => {
    now = t;
    if (element.open && curves?.count) ROWS.forEach(([name, column, digits], i) => (cells[i].textContent = wording(texts, curves, name, column, digits, t)));
  };
  const element = part("details", { class: "numbers", ontoggle: () => at(now) }, part("summary", {}, texts.numbers),
    part("table", {}, part("tbody", {}, ...ROWS.map(([name], i) => part("tr", {}, part("th", { scope: "row" }, texts.number[name][0]), cells[i])))));
  return { element, at, show: (/** @type {any} */ scene) => void (curves = scene.curves[scene.table === "three" ? "ordinary" : scene.table]) };
}

// A quantity at a time, with its unit.
const wording = (texts, curves, name, column, digits, t) =>
  say(texts, `{value}${texts.number[name][1]}`, { value: [column === TIME ? t : curves.at(t, column), digits] });

// Some of them in one line, to be shown at the pointer.
/** @param {Record<string, any>} texts @param {import("../motion/curves.js").Curves} curves @param {string[]} names @param {number} t */
export const lineOf = (texts, curves, names, t) => ROWS.filter(([name]) => name === "t" || names.includes(name))
  .map(([name, column, digits]) => `${name === "t" ? "" : `${texts.number[name][0]} `}${wording(texts, curves, name, column, digits, t)}`).join(" · ");
