// The top of the page's first view, moving before the session has come: app/first.py wrote into the page what its model
// will say. A stand-in for that model draws it, and hands the picture over when the model is there.
import { bytesOf, float32 } from "./data.js";
import { pace, REST } from "./three/stage.js";
import { renderTop3D } from "./three/top3d.js";

const MEANWHILE = 5 * REST; // where the processor draws, it has a page to make
/** @type {Omit<Rendering<TopModel>, "model"> & { values: TopModel, become: (model: TopModel) => void, place: HTMLElement } | null} */
let early = null; // the picture that waits for its model

// What a view asks of a model, until become() puts the session's own behind it.
/** @param {TopModel} values */
function standIn(values) {
  const listeners = [], changed = new Set(); // what a person did before
  /** @type {TopModel | null} */
  let own = null;
  const on = (name, run) => (own ? own.on(name, run) : listeners.push([name, run]));
  const model = new Proxy(/** @type {TopModel} */ ({}), {
    get: (_, name) => (name === "on" ? on : (own ?? values)[name]),
    set(_, name, value) {
      (own ?? values)[name] = value;
      if (!own) changed.add(name);
      return true;
    },
  });
  /** @param {TopModel} its */
  const become = (its) => {
    own = its;
    for (const [name, run] of listeners) its.on(name, run);
    for (const name of changed) its[name] = values[name];
    for (const [name, run] of listeners) if (name in values && !changed.has(name) && !isSame(values[name], its[name])) run();
  };
  return { model, become };
}

function isSame(a, b) {
  if (!(a instanceof ArrayBuffer)) return JSON.stringify(a) === JSON.stringify(b);
  const [one, other] = [a, b].map(float32);
  return one.length === other.length && one.every((value, i) => value === other[i]);
}

// Of the languages that the browser prefers, as the server chooses.
function inOneLanguage(texts) {
  return texts[navigator.languages.map((tag) => tag.split("-")[0].toLowerCase()).find((language) => language in texts) ?? "en"];
}

export function first() {
  /** @returns {any} */
  const part = (id) => document.getElementById(id);
  const place = part("first"), { search, model: said } = JSON.parse(part("first-values").textContent);
  if (location.search !== search) return; // another motion, or another view
  /** @type {any} */
  const values = Object.fromEntries(Object.entries(said).map(([name, value]) =>
    [name, value?.base64 === undefined ? value : bytesOf(value.base64).buffer]));
  values.texts = inOneLanguage(said.texts);
  const { model, become } = standIn(values), view = {}, el = document.createElement("div");
  el.style.height = "100%";
  place.firstElementChild.attachShadow({ mode: "open" }).append(el);
  place.dataset.title = document.title;
  place.hidden = false;
  pace.rest = MEANWHILE;
  renderTop3D({ model, el, view });
  early = { values, become, place, el, view };
}

// As renderTop3D, and the first one takes over what is drawn already.
/** @param {Rendering<TopModel>} rendering */
export function renderFirst({ model, el, view }) {
  if (!early || model.clock) return renderTop3D({ model, el, view });
  const { values, become, place, ...was } = early;
  early = null;
  pace.rest = REST;
  place.remove();
  if (JSON.stringify(model.texts) !== JSON.stringify(values.texts)) {
    was.view.tippe?.dispose();
    return renderTop3D({ model, el, view });
  }
  el.replaceChildren(...was.el.childNodes);
  view.tippe = was.view.tippe;
  become(model);
}
