// The page by keyboard and screen reader: keys for the clock, the list of keys, what the top does in words, and the
// tour.
import { fill, local } from "../data.js";
import { find } from "./finding.js";
import { guideStyle } from "../style.js";
import { Tour, tourFrame } from "./tour.js";

const SAY_MS = 400; // words are spoken once they have not changed for this long
const WRITING = "input, textarea, select, button, a[href], summary, [contenteditable=true], [role=slider], [role=tab], [role=option]";
const TYPING = "input:not([type=range], [type=checkbox]), textarea, [contenteditable=true]";
const KEYS = { " ": { toggle: true }, ArrowLeft: { step: -1 }, ArrowRight: { step: 1 } };

const listOf = (texts) => `<dialog class="list" aria-labelledby="title"><h2 id="title">${texts.keys}</h2>
  <table>${texts.list.map(([key, does]) => `<tr><th scope="row">${key}</th><td>${does}</td></tr>`).join("")}</table>
  <button class="close">${texts.close}</button> <button class="again">${texts.again}</button></dialog>`;

// For screen readers: what the rolling top is doing, while it is shown. The Lab has its own words.
/** @param {GuideModel} model @param {AbortSignal} signal */
function speak(model, signal) {
  const { texts } = model, live = document.createElement("div");
  // A live region is spoken only if it existed before its text was set.
  live.setAttribute("role", "status");
  live.setAttribute("aria-label", texts.now);
  live.style.cssText = "position: absolute; top: 0; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap";
  (find("[role=main], main") ?? document.body).append(live);
  let later, playing;
  const say = (words) => {
    clearTimeout(later);
    later = setTimeout(() => {
      const heard = model.tour ? words : "";
      if (live.textContent !== heard) live.textContent = heard;
    }, SAY_MS);
  };
  const now = () => fill(playing ? texts.playing : texts.paused, { said: model.said });
  const onClock = ({ detail }) => {
    const changed = playing !== undefined && playing !== detail.playing;
    playing = detail.playing;
    if (changed) say(now());
    else if (!playing) {
      const seconds = local((detail.t * model.seconds).toFixed(4));
      say(fill(texts.instant, { seconds, verdict: detail.verdict, said: model.said }));
    }
  };
  window.addEventListener("tippe:clock:lab", onClock, { signal });
  model.on("said", () => say(now()));
  model.on("tour", () => say("")); // clears what was said in another room
  signal.addEventListener("abort", () => {
    clearTimeout(later);
    live.remove();
  });
}

/** @param {any} list the dialog @param {Tour} tour @param {AbortSignal} signal @returns {(event: Event) => void} opens the list */
function listen(list, tour, signal) {
  const openList = (event) => {
    event.preventDefault();
    if (!list.open) list.showModal();
  };
  const onKey = (/** @type {KeyboardEvent} */ event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const target = /** @type {Element} */ (event.composedPath()[0]);
    if (event.key === "?" && !target.matches?.(TYPING)) return openList(event);
    if (event.key === "Escape" && tour.isOn) return tour.end();
    const detail = KEYS[event.key];
    if (target.matches?.(WRITING) || list.open || !detail) return;
    event.preventDefault();
    window.dispatchEvent(new CustomEvent("tippe:command", { detail }));
  };
  window.addEventListener("keydown", onKey, { signal });
  return openList;
}

/** @param {Pick<Rendering<GuideModel>, "model">} rendering */
export function renderGuide({ model }) {
  const { texts } = model, listening = new AbortController(), { signal } = listening;
  const layer = document.createElement("div"); // over the page, outside all its parts
  const over = layer.attachShadow({ mode: "open" });
  over.innerHTML = `<style>${guideStyle}</style>${listOf(texts)}${tourFrame(texts)}`;
  speak(model, signal);
  document.body.append(layer);
  const tour = new Tour(texts, over, signal);
  /** @type {(root: ParentNode, selector: string) => any} */
  const part = (root, selector) => root.querySelector(selector);
  const list = part(over, ".list");
  const openList = listen(list, tour, signal), ask = (/** @type {any} */ event) => {
    if (event.detail === "tour") tour.begin(document.activeElement);
    else openList(event);
  };
  window.addEventListener("tippe:guide", ask, { signal });
  part(over, ".close").onclick = () => list.close();
  part(over, ".again").onclick = () => {
    list.close();
    tour.begin(document.activeElement);
  };
  list.onclick = (event) => event.target === list && list.close();
  const offer = () => {
    part(over, ".again").hidden = !model.tour;
    if (!model.tour && tour.isOn) tour.end();
  };
  model.on("tour", offer);
  offer();
  model.on("remove", () => {
    listening.abort();
    layer.remove();
  });
}
