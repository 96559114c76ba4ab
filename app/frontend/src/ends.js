// How a run can end: app/model/ends.json is the only list, also for Python.
import ends from "../../model/ends.json" with { type: "json" };

const inLab = /** @type {{ in_lab: string, colour: string, on_dark: string }[]} */ (ends.filter((end) => "in_lab" in end));

/** The colours as CSS custom properties, --end-leans and so on, with the names that the Lab uses.
 * @param {boolean} dark @returns {Record<string, string>} */
export const endColours = (dark) => Object.fromEntries(inLab.map((end) => [`--end-${end.in_lab}`, end[dark ? "on_dark" : "colour"]]));

/** CSS rules that give an element its colour if it has the class `end` and the name of an end. */
export const endRules = inLab.map(({ in_lab: name }) => `.end.${name} { background: var(--end-${name}); }`).join(" ");
