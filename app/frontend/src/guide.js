// The page by keyboard and by ear: keys for the clock, the list of them, what the top does in words, and the tour.
import { guideStyle } from "./style.js";

const KEYS = [
  ["Space", "play or pause"],
  ["← →", "one frame back or forward"],
  ["Tab, Shift+Tab", "to the next control, or the one before"],
  ["← → in a slider", "one step; Page Up, Page Down ten; Home, End to its ends"],
  ["← → on the axis of the paused top", "tilt it"],
  ["Shift and ← → ↑ ↓ on a picture in 3-D", "turn it; + and − zoom"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
  ["?", "this list"],
];
// A name of the place, and what to do there.
const STOPS = [
  [".picture canvas[aria-label^='The top']", "The top", "It rolls as the paper computes. Drag to turn the view. Pause it, and you can drag its axis to another tilt."],
  ["input[type=range][aria-label^='Jellett']", "The constants", "Three numbers fix the motion: Jellett’s, Routh’s and the energy. Slide one, and everything on the page follows."],
  ["[data-figure=plane]", "Which motions roll", "Each line is a motion, from its least to its largest tilt. Click another line, or pull the blue one by its ends."],
  ["canvas[aria-label^='Figure 5']", "The same in 3-D", "Fig. 5 of the paper. Turn it, read values off it, or pull the blue line on its floor."],
  ["[role=tab] >> Three planes", "And further", "Let the table slip, build your own top, compare families, or take the lesson. “Share” keeps what you found."],
];
const SEEN = "tippe:tour";
const SAY_MS = 400; // words wait until they stay
const writing = "input, textarea, select, button, a[href], summary, [contenteditable=true], [role=slider], [role=tab], [role=option]";

// Elements lie in the shadow roots of many components.
function find(selector, root = document) {
  const [css, text] = selector.split(" >> ");
  for (const element of root.querySelectorAll("*")) {
    if (element.matches(css) && element.getClientRects().length && (!text || element.textContent.includes(text))) return element;
    const inside = element.shadowRoot && find(selector, element.shadowRoot);
    if (inside) return inside;
  }
  return null;
}

export function renderGuide({ model, el }) {
  el.innerHTML = `<style>${guideStyle}</style><button class="head-button tour">Tour</button><button class="head-button keys" aria-label="Keys" title="Keys (?)">?</button>`;
  const listening = new AbortController(), { signal } = listening;
  const layer = document.createElement("div"); // over the page, and not within any part of it
  layer.attachShadow({ mode: "open" }).innerHTML = `<style>${guideStyle}</style>
    <dialog class="list" aria-labelledby="title"><h2 id="title">Keys</h2><table>${KEYS.map(([key, does]) => `<tr><th scope="row">${key}</th><td>${does}</td></tr>`).join("")}</table>
      <button class="close">Close</button> <button class="again">Take the tour</button></dialog>
    <div class="ring" hidden></div>
    <div class="stop" role="dialog" aria-labelledby="name" aria-describedby="what" hidden><h2 id="name" tabindex="-1"></h2><p id="what"></p>
      <div><span class="count"></span><button class="skip">Skip</button><button class="back">Back</button><button class="next">Next</button></div></div>`;
  // A live region is only heard where it was before its words came.
  const live = document.createElement("div");
  live.setAttribute("role", "status");
  live.setAttribute("aria-label", "What the top does now");
  live.style.cssText = "position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap";
  (find("[role=main], main") ?? document.body).append(live);
  document.body.append(layer);
  const part = (selector) => layer.shadowRoot.querySelector(selector);
  const [list, ring, stop] = [".list", ".ring", ".stop"].map(part);

  // What the top does now
  let later, playing;
  const say = (words) => {
    clearTimeout(later);
    later = setTimeout(() => {
      if (live.textContent !== words) live.textContent = words;
    }, SAY_MS);
  };
  const now = () => `${playing ? "Playing. " : "Paused. "}${model.said}`;
  window.addEventListener(
    "tippe:clock",
    ({ detail }) => {
      const changed = playing !== undefined && playing !== detail.playing;
      playing = detail.playing;
      if (changed) say(now());
      else if (!playing) say(`${(detail.t * model.seconds).toFixed(4)} seconds, ${detail.verdict}. ${model.said}`);
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
      const target = event.composedPath()[0], typing = target.matches?.("input:not([type=range], [type=checkbox]), textarea, [contenteditable=true]");
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
  el.querySelector(".keys").onclick = openList;
  part(".close").onclick = () => list.close();
  part(".again").onclick = () => {
    list.close();
    begin(document.activeElement);
  };
  list.onclick = (event) => event.target === list && list.close();

  // The tour
  let at = 0, target = null, from = null, watching;
  function begin(active = null) {
    from = active;
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
    const [selector, name, what] = STOPS[at];
    part("#name").textContent = name;
    part("#what").textContent = what;
    part(".count").textContent = `${at + 1} of ${STOPS.length}`;
    part(".back").hidden = at === 0;
    part(".next").textContent = at === STOPS.length - 1 ? "Done" : "Next";
    target = find(selector);
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
    if (!target?.isConnected) target = find(STOPS[at][0]);
    const seen = target?.getBoundingClientRect(), box = seen?.right > 0 && seen, { offsetWidth: wide, offsetHeight: high } = stop, GAP = 14;
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
    const [, , left, top] = rooms.find(([room, needs]) => room > needs + 2 * GAP) ?? rooms.at(box.top > innerHeight - box.bottom ? 3 : 2);
    Object.assign(stop.style, { left: `${inside(left, innerWidth - wide)}px`, top: `${inside(top, innerHeight - high)}px` });
  }
  el.querySelector(".tour").onclick = () => begin(document.activeElement);
  part(".skip").onclick = end;
  part(".back").onclick = () => go(at - 1);
  part(".next").onclick = () => go(at + 1);
  window.addEventListener("resize", place, { signal });
  window.addEventListener("scroll", place, { signal, capture: true });
  // Offered once, and only where nobody follows a link to something particular.
  if (!localStorage.getItem(SEEN) && !location.search) {
    const first = () => {
      if (find(STOPS[0][0])) begin();
    };
    window.addEventListener("tippe:clock", () => setTimeout(first), { once: true, signal });
  }

  model.on("remove", () => {
    listening.abort();
    clearTimeout(later);
    clearInterval(watching);
    layer.remove();
    live.remove();
  });
}
