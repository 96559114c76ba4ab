// Figures of Bokeh's, made in the browser from a description that all pages have in common; Python sends what differs.
import { part } from "../parts.js";
import { set } from "../data.js";
import { atEnd, follow, lifeOf } from "../life.js";

const SHARES = 8; // of the data, as in app/widgets/drawing.py
const style = `
.figure { position: relative; min-width: 0; min-height: 0; }
.figures { height: 100%; }
.one:only-child { height: 100%; }
`;

class Drawing {
  /** @param {Rendering<DrawingModel>} rendering */
  constructor(rendering) {
    const { model, el } = rendering, { doc, heights } = JSON.parse(model.described);
    this.model = model;
    this.known = new Map(); // what Python has set: for each source its data, for each model and property its JSON
    /** @type {Record<string, Record<string, any>>} */
    this.own = {}; // of each model that Python has changed: what these properties are in the description
    this.isPutting = false;
    this.doc = Bokeh.require("document").Document.from_json(doc);
    for (let share = 0; share < SHARES; share++) follow(model, [`data${share}`], () => this.put(model[`data${share}`]));
    follow(model, ["looks"], () => this.look());
    follow(model, ["heard"], () => this.listen());
    const places = heights.map((height) => part("div", { class: "figure", style: `height:${height ? `${height}px` : "100%"}` }));
    const heads = heights.map(() => part("div", { class: "head" }));
    follow(model, ["heads"], () => heads.forEach((head, i) => (head.innerHTML = model.heads[i] ?? "")));
    const all = part("div", { class: "figures" }, ...places.map((place, i) => part("div", { class: "one" }, heads[i], place)));
    el.replaceChildren(part("style", {}, style), all);
    const life = lifeOf(rendering);
    window.dispatchEvent(new CustomEvent("tippe:figures")); // before they are seen: in light and dark they differ
    Bokeh.embed.add_document_standalone(this.doc, el, places).then((views) => {
      atEnd(life, () => this.remove(views));
      if (life.aborted) this.remove(views);
    });
  }

  put(share) {
    this.isPutting = true;
    for (const [id, data] of Object.entries(share)) {
      if (this.known.get(id) === data) continue;
      this.known.set(id, data);
      this.doc.get_model_by_id(id).data = data;
    }
    this.isPutting = false;
  }

  // What is new: another value may have been set here meanwhile, by the clock or a hand.
  look() {
    for (const [id, values] of Object.entries(this.model.looks)) {
      const shown = this.doc.get_model_by_id(id), own = this.own[id] ??= {};
      for (const name of Object.keys(values)) own[name] ??= shown[name];
      const isNew = ([name, value]) => this.known.get(`${id} ${name}`) !== JSON.stringify(value);
      const news = Object.entries({ ...own, ...values }).filter(isNew);
      for (const [name, value] of news) this.known.set(`${id} ${name}`, JSON.stringify(value));
      if (news.length) shown.setv(Object.fromEntries(news));
    }
  }

  listen() {
    for (const id of this.model.heard) {
      if (this.known.has(`${id} is heard`)) continue;
      this.known.set(`${id} is heard`, true);
      const source = this.doc.get_model_by_id(id);
      source.properties.data.change.connect(() => this.isPutting || set(this.model, "sent", [this.model.sent[0] + 1, id, source.data]));
    }
  }

  remove(views) {
    views.clear();
    const at = Bokeh.documents.indexOf(this.doc);
    if (at >= 0) Bokeh.documents.splice(at, 1);
  }
}

/** @param {Rendering<DrawingModel>} rendering */
export const renderDrawing = (rendering) => void new Drawing(rendering);
