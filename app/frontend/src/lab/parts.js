// Creates elements of HTML and SVG, and writes numbers.
import { fill as filled } from "../data.js";

export { Choice, drawn, dress, icon, part } from "../widgets/parts.js";

// Writes a number as in the language of the page, with a true minus sign.
/** @param {number} value @param {number} digits @param {string} decimal */
export function written(value, digits, decimal) {
  const text = Math.abs(value).toFixed(digits);
  return `${value < 0 && Number(text) ? "−" : ""}${text.replace(".", decimal)}`;
}

// Reads a number that a person typed; NaN if it is none.
/** @param {string} text */
export function read(text) {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  return plain === "" ? NaN : Number(plain);
}

// Puts numbers into a text, written as in the language of the page.
/** @param {Record<string, any>} texts @param {string} text @param {Record<string, any>} values */
export const say = (texts, text, values) =>
  filled(text, Object.fromEntries(Object.entries(values).map(([name, value]) =>
    [name, Array.isArray(value) ? written(value[0], value[1], texts.decimal) : value])));
