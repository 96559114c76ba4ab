// How the page looks: light or dark, and large for a projector. The page's own type and the widgets follow by variables
// of CSS; of a Bokeh figure, which is drawn on a canvas, the inks and sizes are exchanged here.
import { modelsOf } from "../borrowed.js";
import { colours } from "../colours.js";
import { coalesce } from "../data.js";
import { words } from "../three/scene.js";

const LARGER = 1.35;
const INKS = [colours.ink, colours.faint, "#e7ebef", "#ffffff"]; // and grid, paper of app/widgets/plots.py
const looks = {
  light: INKS,
  "light large": ["#000000", "#4a5661", "#c9d0d7", "#ffffff"],
  dark: ["#eef2f6", "#9aa7b4", "#333d48", "#161c23"],
  "dark large": ["#ffffff", "#c4ccd4", "#4a5661", "#000000"],
};
const FAINT_TYPE = { light: "#5b6875", "light large": "#26323d", dark: "#aab6c2", "dark large": "#e3e8ed" };

/** @param {Pick<Rendering<LookModel>, "model">} rendering */
export function renderLook({ model }) {
  document.documentElement.lang = model.texts.language;
  const first = new WeakMap(); // model -> what its inks and sizes were
  let name = "light";

  const exchange = (value, as) => {
    if (value && typeof value === "object" && typeof value.value === "string") return { ...value, value: as(value.value) };
    return typeof value === "string" ? as(value) : value;
  };
  const ink = (value) => looks[name][INKS.indexOf(value.toLowerCase())] ?? value;
  const size = (value) => (model.large ? value.replace(/^[\d.]+(?=px)/, (px) => String(LARGER * px)) : value);

  function dress(figurePart) {
    let own = first.get(figurePart);
    if (!own) {
      own = {};
      for (const property in figurePart.attributes) {
        if (property.endsWith("_color") || property.endsWith("font_size")) own[property] = figurePart.attributes[property];
      }
      first.set(figurePart, own);
    }
    let wanted = Object.entries(own).map(([property, value]) => [property, exchange(value, property.endsWith("_color") ? ink : size)]);
    // The theme of the widgets gives these values of its own, whatever the figure was made with.
    const [text, faint, line] = looks[name], px = `${12 * (model.large ? LARGER : 1)}px`;
    if (figurePart.type.endsWith("Axis")) {
      wanted = [["major_label_text_color", text], ["major_label_text_font_size", px], ["axis_line_color", faint], ["major_tick_line_color", faint]];
    } else if (figurePart.type === "Grid") wanted = [["grid_line_color", line]];
    if (wanted.length) figurePart.setv(Object.fromEntries(wanted), { sync: false });
  }

  const documentOf = () => Bokeh.documents.find((doc) => modelsOf(doc).has(model.id)) ?? Bokeh.documents[0];
  let seen = 0;
  function dressAll() {
    const all = [...modelsOf(documentOf()).values()];
    seen = all.length;
    for (const part of all) {
      if (part.type?.startsWith("panel.") || !part.attributes) continue;
      dress(part);
    }
  }

  function update() {
    name = `${model.dark ? "dark" : "light"}${model.large ? " large" : ""}`;
    const [inkNow, , line, paper] = looks[name], root = document.documentElement;
    const values = {
      "--ink": inkNow, "--faint": FAINT_TYPE[name], "--rule": line, "--card": paper, "--alert": model.dark ? "#ffb4ab" : "#b3261e",
      "--focus": model.dark ? "#56b4e9" : "#0072b2", "--link": model.dark ? "#8ec7f5" : "#0b5cad",
      "--type": model.large ? LARGER : 1, ...words[model.dark ? "dark" : "light"],
    };
    for (const [property, value] of Object.entries(values)) root.style.setProperty(property, String(value));
    for (const [property, value] of Object.entries(model.on_dark)) {
      // what the widgets read, and what the page itself has
      for (const prefix of ["--look-", "--mui-palette-"]) {
        if (model.dark) root.style.setProperty(prefix + property, value);
        else root.style.removeProperty(prefix + property);
      }
    }
    root.style.colorScheme = model.dark ? "dark" : "light"; // of what the browser draws
    root.style.setProperty("--look-scheme", root.style.colorScheme);
    root.style.setProperty("--panel-on-background-color", inkNow);
    root.style.fontSize = model.large ? `${100 * LARGER}%` : "";
    root.dataset.look = name;
    window.dispatchEvent(new CustomEvent("tippe:look"));
    dressAll();
  }

  // A tab is made when it is first looked at: then there are more models to dress. And the widgets' own dark theme has
  // inks for figures, which come later.
  const doc = documentOf();
  const again = coalesce(dressAll);
  const onChange = ({ attr = "" }) => {
    if (name !== "light" && (modelsOf(doc).size !== seen || /(_color|font_size)$/.test(attr))) again();
  };
  doc.on_change(onChange);
  model.on("dark", update);
  model.on("large", update);
  model.on("remove", () => {
    again.cancel();
    doc.remove_on_change(onChange);
  });
  if (model.dark || model.large) update();
}
