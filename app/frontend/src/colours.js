// One colour for each quantity: app/model/colours.json is the only list, also for Python. `accent` is the blue of the
// page: what is selected, or can be clicked; `wood` is a top.
import all from "../../model/colours.json" with { type: "json" };

const { on_dark, ...colours } = all;
export { colours };
export const onDark = { ...colours, ...on_dark };
const bothOf = new Map(Object.entries(colours).map(([name, light]) => [light.toLowerCase(), `light-dark(${light}, ${onDark[name]})`]));
/** A colour that Python sent, as CSS that is legible on both grounds. @param {string} colour */
export const onBoth = (colour) => bothOf.get(colour.toLowerCase()) ?? colour;
