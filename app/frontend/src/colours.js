// One colour for each quantity: app/model/colours.json is the only list, also for Python. `chosen` is for what is
// selected or can be clicked, `accent` is the blue of the page, `wood` is a top. Text and thin lines use the variant
// for the background they are on.
import all from "../../model/colours.json" with { type: "json" };

const { on_light, on_dark, ...colours } = all;
export { colours };
export const onLight = { ...colours, ...on_light };
export const onDark = { ...colours, ...on_dark };
