// Elements of the page and of a drawing, and numbers in words.
import { fill as filled } from "../data.js";

export { Choice, drawn, part } from "../widgets/parts.js";

// A number as it is written in the page's language, with a true minus sign.
/** @param {number} value @param {number} digits @param {string} decimal */
export function written(value, digits, decimal) {
  const text = Math.abs(value).toFixed(digits);
  return `${value < 0 && Number(text) ? "−" : ""}${text.replace(".", decimal)}`;
}

// What a person typed, as a number; nan where it is none.
/** @param {string} text */
export function read(text) {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  return plain === "" ? NaN : Number(plain);
}

// Words with their numbers, which are written in the page's language.
/** @param {Record<string, any>} texts @param {string} text @param {Record<string, any>} values */
export const say = (texts, text, values) =>
  filled(text, Object.fromEntries(Object.entries(values).map(([name, value]) =>
    [name, Array.isArray(value) ? written(value[0], value[1], texts.decimal) : value])));
