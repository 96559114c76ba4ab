// The tour of the Lab's research, on request: one part of the page after the other, with words beside it.
import { fill } from "../data.js";
import { placeBeside } from "../figures/readout.js";
import { find } from "./finding.js";

// The parts, in the order of their words.
const STOPS = [
  ".lab .stage",
  ".ctl:has([data-input=K_J])",
  ".plane",
  ".choice[data-input=panel]",
  "[role=tablist]",
];
const PLACED_MS = 200; // ms: the layout of the page may still be changing
const GAP = 14; // px

/** @param {Record<string, string>} texts */
export const tourFrame = (texts) => `<div class="ring" hidden></div>
  <div class="stop" role="dialog" aria-labelledby="name" aria-describedby="what" hidden><h2 id="name" tabindex="-1"></h2><p id="what"></p>
    <div><span class="count"></span><button class="skip">${texts.skip}</button><button class="back">${texts.back}</button><button class="next"></button></div></div>`;

const isWhole = (element) => {
  const box = element?.getBoundingClientRect();
  return box && box.top >= 0 && box.bottom <= innerHeight && box.left >= 0 && box.right <= innerWidth;
};

export class Tour {
  /** @param {Record<string, any>} texts @param {ShadowRoot} over a layer above the page @param {AbortSignal} signal */
  constructor(texts, over, signal) {
    this.texts = texts;
    /** @type {(selector: string) => any} */
    this.part = (selector) => over.querySelector(selector);
    this.ring = this.part(".ring");
    this.stop = this.part(".stop");
    this.at = 0;
    /** @type {HTMLElement | null} */
    this.target = null;
    /** @type {HTMLElement | null} */
    this.from = null; // what had the keyboard focus
    this.part(".skip").onclick = () => this.end();
    this.part(".back").onclick = () => this.go(this.at - 1);
    this.part(".next").onclick = () => this.go(this.at + 1);
    window.addEventListener("resize", () => this.place(), { signal });
    window.addEventListener("scroll", () => this.place(), { signal, capture: true });
    signal.addEventListener("abort", () => clearInterval(this.watching));
  }

  get isOn() { return !this.stop.hidden; }

  /** @param {Element | null} active */
  begin(active) {
    this.from = /** @type {HTMLElement | null} */ (active);
    this.stop.hidden = this.ring.hidden = false;
    this.watching = setInterval(() => this.place(), PLACED_MS);
    this.go(0);
  }

  end() {
    this.stop.hidden = this.ring.hidden = true;
    clearInterval(this.watching);
    this.from?.focus?.();
  }

  /** @param {number} to */
  go(to) {
    const { part, texts } = this;
    if (to >= STOPS.length) return this.end();
    const at = (this.at = Math.max(to, 0)), [name, what] = texts.stops[at];
    part("#name").textContent = name;
    part("#what").textContent = what;
    part(".count").textContent = fill(texts.count, { at: at + 1, all: STOPS.length });
    part(".back").hidden = at === 0;
    part(".next").textContent = at === STOPS.length - 1 ? texts.done : texts.next;
    this.target = find(STOPS[at]);
    if (!isWhole(this.target)) this.target?.scrollIntoView({ block: "center" });
    this.place();
    part("#name").focus({ preventScroll: true });
  }

  place() {
    const { stop, ring } = this;
    if (stop.hidden) return;
    if (!this.target?.isConnected) this.target = find(STOPS[this.at]);
    const seen = this.target?.getBoundingClientRect(), box = seen && seen.right > 0 && seen, { offsetWidth: wide, offsetHeight: high } = stop;
    ring.hidden = !box;
    if (!box) return Object.assign(stop.style, { left: `${(innerWidth - wide) / 2}px`, top: `${innerHeight - high - GAP}px` });
    Object.assign(ring.style, { left: `${box.left - 6}px`, top: `${box.top - 6}px`, width: `${box.width + 12}px`, height: `${box.height + 12}px` });
    const middle = /** @type {[number, number]} */ ([(box.left + box.right) / 2, (box.top + box.bottom) / 2]);
    const { left, top } = placeBeside(middle, { wide, high }, { wide: innerWidth, high: innerHeight }, [box]);
    Object.assign(stop.style, { left: `${left}px`, top: `${top}px` });
  }
}
