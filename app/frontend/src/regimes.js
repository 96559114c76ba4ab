// What a top does at a moment: app/model/regimes.json is the only list, also for Python. A code is an index into it.
import { colours } from "./colours.js";
import regimes from "../../model/regimes.json" with { type: "json" };

const codes = Object.fromEntries(regimes.map(({ name }, code) => [name, code]));
export const ROLLS = codes.rolls;

/** @param {number} code */
export const nameOf = (code) => regimes[code].name;
/** @param {number} code */
export const colourOf = (code) => colours[regimes[code].colour];
/** @param {number} code @param {Record<string, string>} words by the name of the regime */
export const wordOf = (code, words) => words[nameOf(code)];
