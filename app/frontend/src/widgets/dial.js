import { colours } from "../colours.js";
import { ask, fill, local } from "../data.js";

// One control: its name, a slider, a field for a number, words below. Each change is sent to Python as a numbered
// request. Python's answer is used only if it includes the last request, so a late answer cannot move the slider back.
// On a narrow page, what gets the keyboard focus is scrolled to between the stage, which stays visible, and the tabs.
const style = `
:host { display: block; font: calc(13px * var(--type, 1))/1.35 var(--family, system-ui, sans-serif); color: var(--ink, #22303c); }
.head { display: flex; align-items: center; gap: 8px; }
.name { flex: 1; font-size: 1.08em; } .name[title], .words [title] { cursor: help; }
i, sub, sup { font-family: Georgia, serif; } .name i { font-size: 1.2em; } sub, sup { font-size: 0.75em; line-height: 0; }
input { font: inherit; color: inherit; box-sizing: border-box; margin: 0; }
@media (max-width: 999px) { input { scroll-margin: calc(82px * var(--type, 1) + 24px + min(50vh, 400px)) 0 72px; } }
input[type=text] { width: calc(100px * var(--type, 1)); flex: none; height: calc(28px * var(--type, 1)); padding: 2px 8px; text-align: right;
  background: transparent; border: 1px solid var(--edge, #7b8794); border-radius: 4px; font-variant-numeric: tabular-nums; }
input[type=text][aria-invalid=true] { border-bottom-width: 3px; font-weight: 600; }
input:focus-visible { outline: 2px solid var(--focus, ${colours.chosen}); outline-offset: 1px; border-radius: 4px; }
input[type=range] { display: block; width: 100%; height: 26px; accent-color: var(--focus, ${colours.chosen}); cursor: pointer; touch-action: pan-y; }
.marks { position: relative; height: 1.5em; margin: -3px 8px 2px; font-size: calc(12px * var(--type, 1)); color: var(--faint, #5b6875); }
.marks span { position: absolute; transform: translateX(-50%); white-space: nowrap; }
.marks span:first-child { transform: translateX(-8px); }
.marks span::before { content: ""; position: absolute; left: 50%; top: -4px; height: 4px; border-left: 1px solid; }
.marks span:first-child::before { left: 8px; }
.note { color: var(--faint, #5b6875); } .alert { font-weight: 500; }
.alert::before { content: "!" / ""; display: inline-grid; place-items: center; width: 1.5em; height: 1.5em; margin-right: 6px; border-radius: 50%;
  background: var(--ink, #22303c); color: var(--card, white); }
.words button { font: inherit; font-weight: 600; color: inherit; background: none; border: 0; padding: 4px 0; min-height: 28px; text-decoration: underline; cursor: pointer; }
`;
const PAGE = 10; // steps of Page Up and Page Down
const KEYS = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: PAGE, PageDown: -PAGE };

const written = (number) => local(String(Number(number.toPrecision(6))));

// A value in words: with its unit, or its position among the marks.
/** @param {number} value @param {Pick<DialModel, "marks" | "unit" | "texts">} model */
export function spoken(value, { marks, unit, texts }) {
  if (!marks.length) return `${written(value)} ${unit}`;
  const passed = Math.max(marks.filter(([at]) => at <= value).length, 1), [from, to] = [marks[passed - 1], marks[passed]];
  if (value === from[0]) return from[1];
  if (!to) return fill(texts.beyond, { mark: from[1] });
  const percent = Math.round((100 * (value - from[0])) / (to[0] - from[0]));
  return fill(texts.between, { percent, from: from[1], to: to[1] });
}

let made = 0;

class Dial {
  /** @param {DialModel} model @param {HTMLElement} el */
  constructor(model, el) {
    const id = `dial-${(made += 1)}`;
    el.innerHTML = `<style>${style}</style>
      <div class="head"><label class="name" for="${id}"></label><input type="text" autocomplete="off" spellcheck="false" maxlength="60"></div>
      <input type="range" id="${id}" step="any"><div class="marks" aria-hidden="true"></div><div class="words" id="${id}-words"></div>`;
    /** @returns {any} */
    const part = (selector) => el.querySelector(selector);
    this.model = model;
    /** @type {HTMLElement} */
    this.marks = part(".marks");
    /** @type {HTMLElement} */
    this.words = part(".words");
    /** @type {HTMLInputElement} */
    this.entry = part("input[type=text]");
    /** @type {HTMLInputElement} */
    this.slider = part("input[type=range]");
    this.count = 0; // number of the last request
    this.value = 0; // the value of the slider with all its digits
    this.typing = false; // whether the field contains something that has not been requested yet
    this.name(part(".name"));
    this.listen();
    for (const what of ["told", "start", "end"]) model.on(what, () => this.take());
    for (const what of ["words", "wrong", "nearest"]) model.on(what, () => this.say());
    this.take();
    this.say();
  }

  /** @param {HTMLElement} label */
  name(label) {
    const { model, slider, entry } = this;
    label.innerHTML = model.title;
    label.title = model.hint;
    slider.dataset.input = model.input;
    slider.setAttribute("aria-label", model.spoken);
    entry.setAttribute("aria-label", model.unit ? fill(model.texts.entry, { name: model.spoken, unit: model.unit }) : model.spoken);
    for (const input of [slider, entry]) input.setAttribute("aria-describedby", this.words.id);
  }

  listen() {
    const { model, slider, entry } = this;
    slider.addEventListener("input", () => this.slide(Math.round(Number(slider.value) / model.step) * model.step));
    slider.addEventListener("keydown", (event) => {
      const steps = KEYS[event.key], end = { Home: slider.min, End: slider.max }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey || (steps === undefined && end === undefined)) return;
      event.preventDefault();
      this.slide(steps === undefined ? Number(end) : this.value + steps * model.step);
    });
    entry.addEventListener("input", () => (this.typing = true));
    entry.addEventListener("change", () => this.type());
    entry.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.type();
      if (event.key !== "Escape" || !this.typing) return;
      this.typing = false;
      entry.value = model.told[2];
    });
  }

  place() {
    const { model, slider, marks, value } = this;
    slider.min = String(Math.min(model.start, value));
    slider.max = String(Math.max(model.end, value));
    slider.value = String(value);
    slider.setAttribute("aria-valuetext", spoken(value, model));
    const [low, high] = [Number(slider.min), Number(slider.max)];
    marks.hidden = !model.marks.length;
    marks.innerHTML = model.marks.map(([at, word]) => `<span style="left: ${(100 * (at - low)) / (high - low)}%">${word}</span>`).join("");
  }

  /** @param {number | string} wish @param {boolean} typed */
  ask(wish, typed) {
    this.count += 1;
    ask(this.model, [this.count, wish, typed]);
  }

  /** @param {number} wish */
  slide(wish) {
    const { slider } = this, next = Math.min(Math.max(Number(wish.toPrecision(12)), Number(slider.min)), Number(slider.max));
    if (next === this.value) return this.place();
    this.value = next;
    if (!this.model.marks.length) this.entry.value = written(next);
    this.typing = false;
    this.place();
    this.ask(next, false);
  }

  type() {
    if (!this.typing) return;
    this.typing = false;
    this.ask(this.entry.value, true);
  }

  take() {
    const [heard, number, text] = this.model.told;
    if (heard !== this.count) return;
    this.value = number;
    if (!this.typing) this.entry.value = text;
    this.place();
  }

  // A button that takes a value.
  /** @param {number} value @param {string} says */
  remedy(value, says) {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: says, onclick: () => {
      this.typing = false;
      this.ask(value, false);
    } });
    return button;
  }

  say() {
    const { model, words, entry } = this;
    words.innerHTML = model.words;
    if (model.nearest.length) words.append(this.remedy(...model.nearest));
    words.style.minHeight = model.lines ? `${1.35 * model.lines}em` : "";
    entry.setAttribute("aria-invalid", String(model.wrong));
  }
}

/** @param {Rendering<DialModel>} rendering */
export function renderDial({ model, el }) {
  return void new Dial(model, el);
}
