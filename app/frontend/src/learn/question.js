// The question of a step: the possible guesses and, after the answer has been watched, the right one and why.
import { part, say, typeset } from "../parts.js";

// How a guess compares with the truth.
/** @param {any} asks @param {any} truth @param {any} guess */
export function verdictOf(asks, truth, guess) {
  if (Number.isNaN(guess)) return "unsure"; // nobody guessed: the answer was shown to all
  if (asks.options) return guess === asks.unsure ? "unsure" : guess === truth ? "right" : "off";
  if (truth === null) return "never";
  const apart = Math.abs(guess - truth);
  return apart <= asks.near ? "right" : apart <= 3 * asks.near ? "near" : "off";
}

const digitsOf = (step) => (step < 1 ? 1 : 0);

export class Question {
  /**
   * @param {Record<string, any>} texts
   * @param {{ guess(value: any): void, watch(): void, skip(): void, next(): void, lab(): void }} hand
   */
  constructor(texts, hand) {
    this.texts = texts;
    this.hand = hand;
    this.hint = part("p", { class: "hint" });
    this.place = part("div", { class: "answers" });
    this.verdict = part("div", { class: "told", role: "status" });
    this.watch = part("button", { class: "primary", type: "button", onclick: () => hand.watch() });
    this.next = part("button", { class: "primary", type: "button", onclick: () => hand.next() }, `${texts.lesson.next} →`);
    this.guess = part("span", { class: "small" }, texts.lesson.guess);
    this.skip = part("button", { class: "link", type: "button", hidden: true, onclick: () => hand.skip() }, texts.lesson.skip);
    this.end = part("div", { class: "end" });
    this.dock = part("div", { class: "dock" }, this.watch, this.next, this.guess, this.skip);
    this.element = part("section", { class: "side" }, this.hint, this.place, this.verdict, this.end, this.dock);
  }

  show(step, record, { playing, last, learned }) {
    const { texts: { lesson } } = this;
    this.step = step;
    this.record = record;
    this.hint.innerHTML = step.refused || step.hint || "";
    const shown = `${step.name} ${Boolean(record.requested)} ${Boolean(record.done)} ${JSON.stringify(step.asks)}`;
    if (shown !== this.shown) {
      this.shown = shown;
      this.place.replaceChildren(...(step.refused || record.done ? [] : step.asks.options ? this.options() : this.slider()));
      this.verdict.replaceChildren(...(record.done ? this.told() : []));
      this.end.replaceChildren(...(record.done && learned.length ? this.ended(learned) : []));
    }
    this.hint.hidden = Boolean(record.done);
    this.watch.hidden = Boolean(step.refused);
    this.next.hidden = last || !(record.done || step.refused);
    this.watch.textContent = record.done ? lesson.again : lesson.watch;
    this.watch.classList.toggle("quiet", Boolean(record.done));
    this.guess.hidden = Boolean(record.done || record.requested || step.refused);
    this.plays(playing);
  }

  // While the run plays there is nothing to press, until what decides the answer has been seen.
  plays(playing, isDecided = false) {
    const { record, texts: { lesson } } = this, watching = record.requested && !record.done;
    this.watch.disabled = record.guess === undefined || (watching && playing);
    this.skip.hidden = !(watching && playing && isDecided);
    if (watching) this.watch.textContent = playing ? lesson.watching : lesson.watch;
  }

  options() {
    const { step, record, hand, texts } = this;
    return [part("fieldset", {}, part("legend", {}, texts.lesson.answers), ...step.asks.options.map(([key, word]) => {
      const input = part("input", { type: "radio", name: "lesson-guess", value: key, onchange: () => hand.guess(key) });
      input.checked = record.guess === key;
      input.disabled = Boolean(record.requested);
      return part("label", { class: "option" }, input, part("span", {}, word));
    }))];
  }

  // A number counts only after a person has chosen it.
  slider() {
    const { step: { asks }, record, hand, texts } = this, { lesson } = texts, digits = digitsOf(asks.step);
    const words = part("label", { for: "lesson-number" });
    const input = part("input", { id: "lesson-number", type: "range", min: asks.low, max: asks.high, step: asks.step });
    const put = (value) => {
      const known = value !== undefined;
      input.classList.toggle("unset", !known);
      const values = { value: [value ?? 0, digits], unit: asks.unit };
      words.textContent = known ? say(texts, lesson.number, values) : lesson.number_none;
      input.setAttribute("aria-valuetext", known ? say(texts, lesson.number_says, values) : lesson.number_none);
    };
    input.value = String(record.guess ?? (asks.low + asks.high) / 2);
    input.oninput = () => {
      put(Number(input.value));
      hand.guess(Number(input.value));
    };
    put(record.guess);
    return [part("div", { class: "number" }, words, input)];
  }

  // After the last step: what has been learned, and where to try it.
  ended(learned) {
    const { hand, texts: { lesson } } = this;
    return [part("p", { class: "big" }, lesson.done), part("ol", {}, ...learned.map((words) => Object.assign(part("li"), { innerHTML: words }))),
      part("button", { type: "button", class: "primary", onclick: () => hand.lab() }, lesson.lab)];
  }

  word(value) {
    const { step: { asks }, texts } = this;
    if (asks.options) return asks.options.find(([key]) => key === value)?.[1] ?? "";
    return value === null ? texts.lesson.never : say(texts, texts.lesson.number_says, { value: [value, digitsOf(asks.step)], unit: asks.unit });
  }

  told() {
    const { step, record, texts: { lesson } } = this, verdict = verdictOf(step.asks, step.truth, record.guess);
    const row = (name, words) => part("p", {}, part("b", {}, `${name}: `), words);
    const html = (words, kind) => Object.assign(part("p", { class: kind }), { innerHTML: words });
    const found = [part("p", { class: "big" }, lesson[verdict]), row(lesson.truth, this.word(step.truth))];
    if (verdict !== "right" && verdict !== "unsure") found.splice(1, 0, row(lesson.yours, this.word(record.guess)));
    found.push(...step.told.map((words) => html(words, "")));
    if (step.tex.length) found.push(part("div", { class: "equations" }, ...step.tex.map((tex) => typeset(tex, { class: "equation" }))));
    const learned = html(step.learned, "");
    learned.prepend(part("b", {}, `${lesson.learned}: `));
    found.push(part("div", { class: "learned" }, learned));
    if (step.sources.length) found.push(part("details", { class: "small" }, part("summary", {}, `${lesson.read}: ${step.sources.map(([, short]) => short).join(" · ")}`), ...step.sources.map(([, , full]) => html(full, ""))));
    if (step.opens && lesson.open) found.push(part("a", { class: "link", href: step.opens, target: "_blank" }, lesson.open)); // beside the lesson, which goes on
    return found;
  }
}
