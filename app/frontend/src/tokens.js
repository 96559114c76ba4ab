// The colours of the page, light and dark, and with more contrast where it is large: one sheet, on the root, from which
// every part inherits. Those of quantities are in colours.js, those of ends in ends.js, those of objects in three/scene.js.
import { colours, onDark } from "./colours.js";
import { endColours } from "./ends.js";

const scene = {
  light: { scene: "#f1efea", "scene-ink": "#1b2430", "scene-faint": "#4a5563", pill: "#ffffffe6", halo: "#fff", shape: "#55606c" },
  dark: { scene: "#191f25", "scene-ink": "#eef2f5", "scene-faint": "#b6c1cc", pill: "#0e1318e6", halo: "#0e1318", shape: "#a9b4bf" },
};
// ink: text and curves; faint: lesser text; rule, control-line: thin lines and those of controls; card: the ground.
const looks = {
  light: { ink: colours.ink, faint: "#55606c", rule: "#d8dce0", "control-line": colours.faint, card: "#ffffff" },
  "light large": { ink: "#000000", faint: "#26323d", rule: "#c9d0d7", "control-line": "#4a5661", card: "#ffffff" },
  dark: { ink: onDark.ink, faint: "#a9b4bf", rule: "#2d363f", "control-line": "#75818d", card: "#0e1318" },
  "dark large": { ink: "#ffffff", faint: "#e3e8ed", rule: "#4a5661", "control-line": "#c4ccd4", card: "#0e1318" },
};

/** @param {string} name a look: light or dark, and perhaps large @returns {Record<string, string>} */
export const tokensOf = (name) => {
  const dark = name.startsWith("dark"), quantities = dark ? onDark : colours;
  return { ...quantities, ...looks[name], ...scene[dark ? "dark" : "light"], focus: quantities.accent, link: quantities.accent };
};

// Sets them, and says which look it is.
/** @param {string} name */
export function wear(name) {
  const { style, dataset } = document.documentElement, dark = name.startsWith("dark");
  for (const [token, value] of Object.entries(tokensOf(name))) style.setProperty(`--${token}`, value);
  for (const [token, value] of Object.entries(endColours(dark))) style.setProperty(token, value);
  style.colorScheme = dark ? "dark" : "light"; // for what the browser draws itself
  dataset.look = name;
}
