// How a run ends: app/model/ends.json is the one list, for Python too.
import ends from "../../model/ends.json" with { type: "json" };

const inLab = /** @type {{ in_lab: string, colour: string, on_dark: string }[]} */ (ends.filter((end) => "in_lab" in end));

/** The custom properties of their colours, for CSS: --end-leans and so on, by the Lab's names.
 * @param {boolean} dark @returns {Record<string, string>} */
export const endColours = (dark) => Object.fromEntries(inLab.map((end) => [`--end-${end.in_lab}`, end[dark ? "on_dark" : "colour"]]));
const declared = (dark) => Object.entries(endColours(dark)).map(([name, colour]) => `${name}: ${colour};`).join(" ");
export const endsOnLight = declared(false), endsOnDark = declared(true);

/** The rules that give a part of the class `end` and the name of an end its colour. */
export const endRules = inLab.map(({ in_lab: name }) => `.end.${name} { background: var(--end-${name}); }`).join(" ");
