// The page by keyboard and screen reader: keys for the clock, the list of keys, what the top does in words, and the
// tour.
import { debounce } from "../data.js";
import { atEnd, follow, lifeOf } from "../life.js";
import { find } from "./finding.js";
import { part } from "../parts.js";
import { guideStyle } from "../style.js";
import { Tour, tourFrame } from "./tour.js";

const SAY_MS = 400; // words are spoken once they have not changed for this long
const WRITING = "input, textarea, select, button, a[href], summary, [contenteditable=true], [role=slider], [role=tab], [role=option]";
const KEYS = { " ": { toggle: true }, ArrowLeft: { step: -1 }, ArrowRight: { step: 1 } };

const listOf = (texts) => `<dialog class="list" aria-labelledby="title"><h2 id="title" tabindex="-1">${texts.keys}</h2>
  <table>${texts.list.map(([key, does]) => `<tr><th scope="row">${key}</th><td>${does}</td></tr>`).join("")}</table>
  <button class="close">${texts.close}</button> <button class="again">${texts.again}</button></dialog>`;

const statementOf = ({ statement: [[title, about], ...parts], close }) => `<dialog class="statement" aria-labelledby="statement"><h2 id="statement" tabindex="-1">${title}</h2>
  ${paragraphs(about)}${parts.map(([heading, wording]) => `<h3>${heading}</h3>${paragraphs(wording)}`).join("")}<button class="close">${close}</button></dialog>`;
const paragraphs = (wording) => wording.map((words) => `<p>${words}</p>`).join("");

// For screen readers: how the top rolls, while its constants are shown. The stage of the Lab says what it does there.
/** @param {GuideModel} model @param {AbortSignal} signal */
function speak(model, signal) {
  // A live region is spoken only if it existed before its text was set.
  const live = part("div", { role: "status", "aria-label": model.texts.now,
    style: "position: absolute; top: 0; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap" });
  (find("[role=main], main") ?? document.body).append(live);
  follow(model, ["wording", "tour"], debounce(() => {
    const heard = model.tour ? model.wording : "";
    if (live.textContent !== heard) live.textContent = heard;
  }, SAY_MS, signal));
  atEnd(signal, () => live.remove());
}

/** @param {HTMLDialogElement[]} dialogs the first lists the keys @param {Tour} tour @param {AbortSignal} signal */
function listen(dialogs, tour, signal) {
  const onKey = (/** @type {KeyboardEvent} */ event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const target = /** @type {Element} */ (event.composedPath()[0]), isOpen = dialogs.some(({ open }) => open);
    if (event.key === "F1") {
      event.preventDefault();
      if (!isOpen) dialogs[0].showModal();
      return;
    }
    if (event.key === "Escape" && tour.isOn) return tour.end();
    const detail = KEYS[event.key];
    if (target.matches?.(WRITING) || isOpen || !detail) return;
    event.preventDefault();
    window.dispatchEvent(new CustomEvent("tippe:command", { detail }));
  };
  window.addEventListener("keydown", onKey, { signal });
}

/** @param {Pick<Rendering<GuideModel>, "model">} rendering */
export function renderGuide({ model }) {
  const { texts } = model, signal = lifeOf({ model });
  const layer = part("div"); // over the page, outside all its parts
  const over = layer.attachShadow({ mode: "open" });
  over.innerHTML = `<style>${guideStyle}</style>${listOf(texts)}${statementOf(/** @type {any} */ (texts))}${tourFrame(texts)}`;
  speak(model, signal);
  document.body.append(layer);
  const tour = new Tour(texts, over, signal);
  /** @type {(root: ParentNode, selector: string) => any} */
  const within = (root, selector) => root.querySelector(selector);
  const dialogs = { keys: within(over, ".list"), statement: within(over, ".statement") };
  listen(Object.values(dialogs), tour, signal);
  const ask = (/** @type {any} */ { detail }) => {
    if (detail === "tour") return tour.begin(document.activeElement);
    dialogs[detail].showModal();
    within(dialogs[detail], "h2").focus(); // a long statement is read from its title on
  };
  window.addEventListener("tippe:guide", ask, { signal });
  for (const dialog of Object.values(dialogs)) {
    within(dialog, ".close").onclick = () => dialog.close();
    dialog.onclick = (event) => event.target === dialog && dialog.close();
  }
  within(over, ".again").onclick = () => {
    dialogs.keys.close();
    tour.begin(document.activeElement);
  };
  follow(model, ["tour"], () => {
    within(over, ".again").hidden = !model.tour;
    if (!model.tour && tour.isOn) tour.end();
  });
  atEnd(signal, () => layer.remove());
}
