// The page by keyboard and by ear: keys for the clock, the list of them, what the top does in words, and the tour.
import { fill } from "../data.js";
import { guideStyle } from "../style.js";

// The places that the tour shows, in the order of their words.
const STOPS = [
  "[data-picture=top] canvas",
  "input[data-input=K_J]",
  "[data-figure=plane]",
  "[data-picture=surface] canvas",
  "[role=tab]:nth-of-type(2)",
];
const SEEN = "tippe:tour";
const SAY_MS = 400; // words wait until they stay
const RENAME_MS = 100; // by then the library has drawn what opened
const writing = "input, textarea, select, button, a[href], summary, [contenteditable=true], [role=slider], [role=tab], [role=option]";

// Elements lie in the shadow roots of many components.
/** @param {string} selector @param {ParentNode} root @returns {HTMLElement | null} */
function find(selector, root = document) {
  for (const element of /** @type {NodeListOf<HTMLElement>} */ (root.querySelectorAll("*"))) {
    if (element.matches(selector) && element.getClientRects().length) return element;
    const inside = element.shadowRoot && find(selector, element.shadowRoot);
    if (inside) return inside;
  }
  return null;
}

/** @param {Rendering<GuideModel>} rendering */
export function renderGuide({ model, el }) {
  const { texts } = model;
  el.innerHTML = `<style>${guideStyle}</style><button class="head-button tour">${texts.tour}</button><button class="head-button keys" aria-label="${texts.keys}" title="${texts.keys_hint}">?</button>`;
  const buttonOf = (name) => /** @type {HTMLButtonElement} */ (el.querySelector(`.${name}`));
  const listening = new AbortController(), { signal } = listening;
  const layer = document.createElement("div"); // over the page, and not within any part of it
  const over = layer.attachShadow({ mode: "open" });
  over.innerHTML = `<style>${guideStyle}</style>
    <dialog class="list" aria-labelledby="title"><h2 id="title">${texts.keys}</h2><table>${texts.list.map(([key, does]) => `<tr><th scope="row">${key}</th><td>${does}</td></tr>`).join("")}</table>
      <button class="close">${texts.close}</button> <button class="again">${texts.again}</button></dialog>
    <div class="ring" hidden></div>
    <div class="stop" role="dialog" aria-labelledby="name" aria-describedby="what" hidden><h2 id="name" tabindex="-1"></h2><p id="what"></p>
      <div><span class="count"></span><button class="skip">${texts.skip}</button><button class="back">${texts.back}</button><button class="next"></button></div></div>`;
  // A live region is only heard where it was before its words came.
  const live = document.createElement("div");
  live.setAttribute("role", "status");
  live.setAttribute("aria-label", texts.now);
  live.style.cssText = "position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap";
  (find("[role=main], main") ?? document.body).append(live);
  document.body.append(layer);
  /** @returns {any} */
  const part = (selector) => over.querySelector(selector);
  const [list, ring, stop] = [".list", ".ring", ".stop"].map(part);

  // The widgets' own library names its buttons in English, and names them anew when a drawer or dialog opens or closes.
  const rename = () => {
    for (const [name, ours] of Object.entries(texts.library)) {
      const button = find(`button[aria-label="${name}"]`);
      for (const as of ["aria-label", "title"]) button?.setAttribute(as, ours);
    }
  };
  const onOpen = ({ attr = "" }) => ["open", "sidebar_open"].includes(attr) && setTimeout(rename, RENAME_MS);
  const doc = Bokeh.documents[0];
  doc.on_change(onOpen);
  setTimeout(rename, RENAME_MS);

  // What the top does now
  let later, playing;
  const say = (words) => {
    clearTimeout(later);
    later = setTimeout(() => {
      if (live.textContent !== words) live.textContent = words;
    }, SAY_MS);
  };
  const now = () => fill(playing ? texts.playing : texts.paused, { said: model.said });
  window.addEventListener(
    "tippe:clock",
    ({ detail }) => {
      const changed = playing !== undefined && playing !== detail.playing;
      playing = detail.playing;
      if (changed) say(now());
      else if (!playing) {
        const seconds = (detail.t * model.seconds).toFixed(4);
        say(fill(texts.instant, { seconds, verdict: detail.verdict, said: model.said }));
      }
    },
    { signal },
  );
  model.on("said", () => say(now()));

  // Keys
  const command = (detail) => window.dispatchEvent(new CustomEvent("tippe:command", { detail }));
  window.addEventListener(
    "keydown",
    (event) => {
      if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
      const target = /** @type {Element} */ (event.composedPath()[0]), typing = target.matches?.("input:not([type=range], [type=checkbox]), textarea, [contenteditable=true]");
      if (event.key === "?" && !typing) return openList(event);
      if (event.key === "Escape" && !stop.hidden) return end();
      if (target.matches?.(writing) || list.open) return;
      const act = { " ": { toggle: true }, ArrowLeft: { step: -1 }, ArrowRight: { step: 1 } }[event.key];
      if (!act) return;
      event.preventDefault();
      command(act);
    },
    { signal },
  );
  function openList(event) {
    event.preventDefault();
    if (!list.open) list.showModal();
  }
  buttonOf("keys").onclick = openList;
  part(".close").onclick = () => list.close();
  part(".again").onclick = () => {
    list.close();
    begin(document.activeElement);
  };
  list.onclick = (event) => event.target === list && list.close();

  // The tour
  /** @type {HTMLElement | null} */
  let target = null;
  /** @type {HTMLElement | null} */
  let from = null;
  let at = 0, watching;
  /** @param {Element | null} [active] */
  function begin(active = null) {
    from = /** @type {HTMLElement | null} */ (active);
    stop.hidden = ring.hidden = false;
    watching = setInterval(place, 200); // the page goes on being laid out
    go(0);
  }
  function end() {
    stop.hidden = ring.hidden = true;
    clearInterval(watching);
    localStorage.setItem(SEEN, "1");
    from?.focus?.();
  }
  function go(to) {
    if (to >= STOPS.length) return end();
    at = Math.max(to, 0);
    const [name, what] = texts.stops[at];
    part("#name").textContent = name;
    part("#what").textContent = what;
    part(".count").textContent = fill(texts.count, { at: at + 1, all: STOPS.length });
    part(".back").hidden = at === 0;
    part(".next").textContent = at === STOPS.length - 1 ? texts.done : texts.next;
    target = find(STOPS[at]);
    if (!isWhole(target)) target?.scrollIntoView({ block: "center" });
    place();
    if (from) part("#name").focus({ preventScroll: true }); // who asked for none keeps the focus
  }
  const isWhole = (element) => {
    const box = element?.getBoundingClientRect();
    return box && box.top >= 0 && box.bottom <= innerHeight && box.left >= 0 && box.right <= innerWidth;
  };
  // Beside what it shows where there is room, else at the end of the window that is farther from it.
  function place() {
    if (stop.hidden) return;
    if (!target?.isConnected) target = find(STOPS[at]);
    const seen = target?.getBoundingClientRect(), box = seen && seen.right > 0 && seen, { offsetWidth: wide, offsetHeight: high } = stop, GAP = 14;
    ring.hidden = !box;
    if (!box) return Object.assign(stop.style, { left: `${(innerWidth - wide) / 2}px`, top: `${innerHeight - high - GAP}px` });
    Object.assign(ring.style, { left: `${box.left - 6}px`, top: `${box.top - 6}px`, width: `${box.width + 12}px`, height: `${box.height + 12}px` });
    const inside = (value, most) => Math.min(Math.max(value, GAP), Math.max(most - GAP, GAP));
    const rooms = [
      [innerWidth - box.right, wide, box.right + GAP, inside(box.top, innerHeight - high)],
      [box.left, wide, box.left - GAP - wide, inside(box.top, innerHeight - high)],
      [innerHeight - box.bottom, high, inside(box.left, innerWidth - wide), box.bottom + GAP],
      [box.top, high, inside(box.left, innerWidth - wide), box.top - GAP - high],
    ];
    const [, , left, top] = rooms.find(([room, needs]) => room > needs + 2 * GAP) ?? rooms[box.top > innerHeight - box.bottom ? 3 : 2];
    Object.assign(stop.style, { left: `${inside(left, innerWidth - wide)}px`, top: `${inside(top, innerHeight - high)}px` });
  }
  buttonOf("tour").onclick = () => begin(document.activeElement);
  part(".skip").onclick = end;
  part(".back").onclick = () => go(at - 1);
  part(".next").onclick = () => go(at + 1);
  window.addEventListener("resize", place, { signal });
  window.addEventListener("scroll", place, { signal, capture: true });
  // Offered once, and only where nobody follows a link to something particular.
  if (!localStorage.getItem(SEEN) && !location.search) {
    const first = () => {
      if (find(STOPS[0])) begin();
    };
    window.addEventListener("tippe:clock", () => setTimeout(first), { once: true, signal });
  }

  model.on("remove", () => {
    listening.abort();
    doc.remove_on_change(onOpen);
    clearTimeout(later);
    clearInterval(watching);
    layer.remove();
    live.remove();
  });
}
