// The look of the page: light or dark, and large for a projector. What is HTML follows through CSS variables; a
// Bokeh figure is drawn on a canvas, so its colours and sizes are replaced here.
import { colours, onDark } from "../colours.js";
import { coalesce } from "../data.js";
import { atEnd, lifeOf } from "../life.js";
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

// Sets CSS variables of the document's root.
/** @param {LookModel} model @param {string} name that of the look */
function setVariables(model, name) {
  const { style } = document.documentElement;
  wear(name);
  style.setProperty("--type", model.large ? String(LARGER) : "");
  style.fontSize = model.large ? `${100 * LARGER}%` : "";
  window.dispatchEvent(new CustomEvent("tippe:look"));
}

class Look {
  system = window.matchMedia("(prefers-color-scheme: dark)");

  /** @param {LookModel} model */
  constructor(model) {
    this.model = model;
    this.first = new WeakMap(); // for each part of a figure, its colours and sizes before any look
    this.name = "light";
    const documents = typeof Bokeh === "undefined" ? [] : Bokeh.documents; // none in a page without a server
    this.doc = documents.find((doc) => doc.get_model_by_id(model.id)) ?? documents[0];
    this.seen = 0;
  }

  // The values that a part of a figure had before any look.
  own(part) {
    let own = this.first.get(part);
    if (own) return own;
    own = Object.fromEntries(Object.entries(part.attributes).filter(([property]) => isColour(property) || property.endsWith("font_size")));
    this.first.set(part, own);
    return own;
  }

  dress(part) {
    const { name, model: { large } } = this;
    const tokens = tokensOf(name), ink = (value) => tokens[INKS[value.toLowerCase()]] ?? (name.startsWith("dark") ? DARK.get(value.toLowerCase()) : undefined) ?? value;
    const size = (value) => (large ? value.replace(/^[\d.]+(?=px)/, (now) => String(LARGER * now)) : value);
    const wanted = Object.entries(this.own(part)).map(([property, value]) => [property, exchange(value, isColour(property) ? ink : size)]);
    if (wanted.length) part.setv(Object.fromEntries(wanted), { sync: false });
  }

  dressAll() {
    const all = [...(this.doc?.all_models ?? [])];
    this.seen = all.length;
    for (const part of all) if (!part.type?.startsWith("panel.") && part.attributes) this.dress(part);
  }

  // As a person chose, otherwise as the operating system has it.
  get isDark() { return this.model.dark ?? this.system.matches; }

  update = () => {
    const { isDark: dark, model: { large } } = this;
    this.name = `${dark ? "dark" : "light"}${large ? " large" : ""}`;
    setVariables(this.model, this.name);
    this.dressAll();
  };

  // Whether new models have come, because a tab is created when it is first opened.
  get isUndone() { return this.name !== "light" && this.doc.all_models.size !== this.seen; }
}

/** @param {Pick<Rendering<LookModel>, "model">} rendering */
export function renderLook({ model }) {
  document.documentElement.lang = model.texts.language;
  const life = lifeOf({ model }), look = new Look(model), again = coalesce(() => look.dressAll(), life);
  const onChange = () => look.isUndone && again();
  look.doc?.on_change(onChange);
  for (const name of ["dark", "large"]) model.on(name, look.update);
  look.system.addEventListener("change", look.update, { signal: life });
  atEnd(life, () => look.doc?.remove_on_change(onChange));
  if (look.isDark || model.large || look.system.matches) look.update();
}
