// One colour a quantity: app/model/colours.json is the one list, for Python too. `chosen` is what is selected, or can be
// clicked; `accent` the page's blue; `wood` a top. Words and thin lines take those of the ground they stand on.
import all from "../../model/colours.json" with { type: "json" };

const { on_light, on_dark, ...colours } = all;
export { colours };
export const onLight = { ...colours, ...on_light };
export const onDark = { ...colours, ...on_dark };
