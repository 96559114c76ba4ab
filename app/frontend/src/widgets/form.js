// Columns of words, and what a hand sets or presses beside them, in one component; Python knows each by its number.
import { renderButton as Button } from "../controls/button.js";
import { renderChoice as Choice } from "../controls/choice.js";
import { renderField as Field } from "../controls/field.js";
import { renderTextFile as TextFile } from "../controls/file.js";
import { renderChecks as Checks, renderMenu as Menu } from "../controls/menu.js";
import { renderStretch as Stretch } from "../controls/stretch.js";
import { set } from "../data.js";
import { atEnd, follow, lifeOf } from "../life.js";
import { part } from "../parts.js";
import { modelOf } from "../stand_in.js";
import { renderDownload as Download } from "./download.js";

/** @type {Record<string, (rendering: any) => any>} */
const kinds = { Button, Checks, Choice, Download, Field, Menu, Stretch, TextFile };
const style = `.column { display: flex; flex-direction: column; } .column > * { flex: 0 0 auto; align-self: stretch; min-width: 0; box-sizing: border-box; } [hidden] { display: none !important; }`;
const styleOfColumn = style + style.replaceAll(".column", ":host"); // of one that has a sheet of its own

class Form {
  /** @param {Rendering<FormModel>} rendering */
  constructor(rendering) {
    this.model = rendering.model;
    this.count = this.model.sent[0];
    this.isShowing = false;
    this.late = new Map(); // of what a hand has set: the message of which Python has not said that it was heard
    /** @type {Map<number, any>} */
    this.parts = new Map(); // each a stand-in for its model, with its values
    const life = lifeOf(rendering), { of } = JSON.parse(this.model.state), { tree, sheets } = JSON.parse(this.model.parts);
    this.sheets = sheets;
    /** @type {HTMLElement[] | undefined} */
    this.others = undefined; // those that still have no place
    rendering.el.replaceChildren(part("style", {}, style), part("div", { class: "column" }, ...tree.map((given) => this.make(given, of))));
    this.model.on("state", () => this.show());
    this.model.on("file", () => this.put(this.model.file[0], { file: this.model.file.slice(1) }));
    atEnd(life, () => this.parts.forEach((_, at) => this.put(at, { remove: {} })));
  }

  make({ kind, at, style: looks, sends = [], sheet, inside }, of) {
    if (kind === "other") return (this.others ??= [...this.model.get_child("others")]).shift();
    const place = part("div", { style: looks }), model = modelOf(of[at]), own = sheet === undefined ? [] : [part("style", {}, this.sheets[sheet])];
    const named = kind === "column" && own.length ? [] : [kind]; // the rules for a column out here would win over its own
    this.parts.set(at, model);
    follow(model, ["visible"], () => (place.hidden = !model.visible));
    follow(model, ["css_classes"], () => (place.className = [...named, ...model.css_classes].join(" ")));
    if (kind === "column") {
      const parts = inside.map((given) => this.make(given, of));
      if (own.length) place.attachShadow({ mode: "open" }).append(part("style", {}, styleOfColumn), ...own, ...parts);
      else place.append(...parts);
      return place;
    }
    const el = part("div");
    place.attachShadow({ mode: "open" }).append(...own, el);
    if (kind === "words") follow(model, ["object"], () => (el.innerHTML = model.object));
    else kinds[kind]({ model, el, view: {} });
    for (const name of sends) model.on(name, () => this.isShowing || this.send(at, name, model[name]));
    return place;
  }

  send(at, name, value) {
    this.late.set(`${at} ${name}`, (this.count += 1));
    set(this.model, "sent", [this.count, at, name, value]);
  }

  // What is new; what a hand has set meanwhile stays.
  show() {
    const { heard, of } = JSON.parse(this.model.state);
    for (const [at, values] of of.entries()) {
      const model = this.parts.get(at), isNew = ([name, value]) => !(this.late.get(`${at} ${name}`) > heard) && JSON.stringify(value) !== JSON.stringify(model[name]);
      this.put(at, Object.fromEntries(Object.entries(values).filter(isNew)));
    }
  }

  put(at, values) {
    this.isShowing = true;
    Object.assign(this.parts.get(at), values);
    this.isShowing = false;
  }
}

/** @param {Rendering<FormModel>} rendering */
export const renderForm = (rendering) => void new Form(rendering);
