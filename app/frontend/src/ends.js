// How a run ends: app/model/ends.json is the one list, for Python too.
import ends from "../../model/ends.json" with { type: "json" };

const inLab = /** @type {{ in_lab: string, colour: string, on_dark: string }[]} */ (ends.filter((end) => "in_lab" in end));

// The custom properties of their colours, for CSS: --end-leans and so on, by the Lab's names.
const declared = (ground) => inLab.map((end) => `--end-${end.in_lab}: ${end[ground]};`).join(" ");
export const endsOnLight = declared("colour"), endsOnDark = declared("on_dark");

/** The rules that give a part of the class `end` and the name of an end its colour. */
export const endRules = inLab.map(({ in_lab: name }) => `.end.${name} { background: var(--end-${name}); }`).join(" ");
