// The look of the page: light or dark, and large for a projector. What is HTML follows through CSS variables; a
// Bokeh figure is drawn on a canvas, so its colours and sizes are replaced here.
import { colours, onDark } from "../colours.js";
import { lifeOf } from "../life.js";
import { tokensOf, wear } from "../tokens.js";

const LARGER = 1.35;
// What a figure is drawn with on a light page, with grid and background of app/widgets/plots.py; and its tokens.
const INKS = { [colours.ink]: "ink", [colours.faint]: "control-line", "#e7ebef": "rule", "#ffffff": "card", [colours.accent]: "accent" };
// of a quantity: its colour on a light page, and that on a dark one
const DARK = new Map(Object.entries(onDark).map(([name, dark]) => [colours[name].toLowerCase(), dark]));

const isColour = (property) => property.endsWith("_color");

// Replaces a value, or the value inside a visual specification.
function exchange(value, as) {
  if (value && typeof value === "object" && typeof value.value === "string") return { ...value, value: as(value.value) };
  return typeof value === "string" ? as(value) : value;
}

// The colours and sizes of a part of a figure before any look.
const ownOf = ({ attributes }) => Object.entries(attributes).filter(([property]) => isColour(property) || property.endsWith("font_size"));

/** @param {Pick<Rendering<LookModel>, "model">} rendering */
export function renderLook({ model }) {
  const { style } = document.documentElement, life = lifeOf({ model }), system = window.matchMedia("(prefers-color-scheme: dark)"), first = new WeakMap();
  let name = "light";
  const dress = (part) => {
    if (!first.has(part)) first.set(part, ownOf(part));
    const tokens = tokensOf(name), ink = (value) => tokens[INKS[value.toLowerCase()]] ?? (name.startsWith("dark") ? DARK.get(value.toLowerCase()) : undefined) ?? value;
    const size = (value) => (model.large ? value.replace(/^[\d.]+(?=px)/, (now) => String(LARGER * now)) : value);
    const wanted = first.get(part).map(([property, value]) => [property, exchange(value, isColour(property) ? ink : size)]);
    if (wanted.length) part.setv(Object.fromEntries(wanted));
  };
  const dressAll = () => {
    const documents = typeof Bokeh === "undefined" ? [] : Bokeh.documents; // none in a page without a server
    for (const part of documents.flatMap((doc) => [...doc.all_models])) if (!part.type?.startsWith("panel.") && part.attributes) dress(part);
  };
  const isDark = () => model.dark ?? system.matches; // as a person chose, otherwise as the operating system has it
  const update = () => {
    const { large } = model;
    name = `${isDark() ? "dark" : "light"}${large ? " large" : ""}`;
    wear(name);
    style.setProperty("--type", large ? String(LARGER) : "");
    style.fontSize = large ? `${100 * LARGER}%` : "";
    window.dispatchEvent(new CustomEvent("tippe:look"));
    dressAll();
  };
  document.documentElement.lang = model.texts.language;
  window.addEventListener("tippe:figures", () => name !== "light" && dressAll(), { signal: life });
  for (const each of ["dark", "large"]) model.on(each, update);
  system.addEventListener("change", update, { signal: life });
  if (isDark() || model.large || system.matches) update();
}
