// The Lab on arrival, moving before the session has started: see app/page/first.py. A stand-in for the Lab's model
// draws the picture, which is handed over when the model arrives.
import { renderLab } from "./lab/lab.js";
import { numbersIn, standIn } from "./stand_in.js";
import { pace, REST } from "./three/stage.js";

const MEANWHILE = 5 * REST; // where the processor draws, it also has to build the page
const SOON = 50; // ms
let isLate = false; // the session came first
/** @type {Omit<Rendering<LabModel>, "model"> & { values: LabModel, become: (model: LabModel) => void, place: HTMLElement } | null} */
let early = null; // the picture that waits for its model

// The language of the address, otherwise one that the browser prefers: the same choice as the server's.
/** @param {Record<string, any>} words @param {string | null} chosen */
export function inOneLanguage(words, chosen) {
  const preferred = navigator.languages.map((tag) => tag.split("-")[0].toLowerCase());
  return words[chosen || preferred.find((language) => language in words) || "en"];
}

/** @param {Promise<Response>} numbers the file, still loading @param {string} language of the address; empty: the browser's */
export async function first(numbers, language) {
  const { body } = await numbers;
  const bytes = await new Response(body?.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  if (isLate) return;
  /** @returns {any} */
  const part = (id) => document.getElementById(id);
  const place = part("first"), values = { ...inOneLanguage(JSON.parse(part("first-words").textContent), language), ...numbersIn(bytes) };
  const { model, become } = standIn(values), view = {}, el = document.createElement("div");
  place.attachShadow({ mode: "open" }).append(el);
  place.dataset.title = document.title;
  place.hidden = false;
  pace.rest = MEANWHILE;
  renderLab({ model, el, view });
  view.tippe?.hold?.(true); // there is no session yet to answer
  early = { values, become, place, el, view };
}

// Like renderLab, but the first call takes over what is already drawn.
/** @param {Rendering<LabModel>} rendering */
export function renderFirst({ model, el, view }) {
  isLate = true;
  if (!early) return renderLab({ model, el, view });
  const { values, become, place, ...was } = early, focused = place.shadowRoot?.activeElement;
  early = null;
  pace.rest = REST;
  for (const type of ["change", "blur"]) place.shadowRoot?.addEventListener(type, (event) => event.stopPropagation(), true); // moving is not leaving
  place.remove();
  if (JSON.stringify(model.texts) !== JSON.stringify(values.texts)) {
    was.view.tippe?.dispose();
    return renderLab({ model, el, view });
  }
  el.replaceChildren(...was.el.childNodes);
  view.tippe = was.view.tippe;
  become(model);
  if (focused instanceof HTMLElement) {
    once(() => focused.isConnected, () => {
      if (document.activeElement === document.body) focused.focus({ preventScroll: true }); // unless it went elsewhere
    });
  }
  // If the server hears something before the page has reported that it is complete, it answers only after the next
  // message.
  once(() => Bokeh.documents.some((doc) => doc.is_idle), () => view.tippe?.hold?.(false));
}

/** @param {() => boolean} ready @param {() => void} run */
function once(ready, run) {
  if (ready()) run();
  else setTimeout(() => once(ready, run), SOON);
}
