// The lesson: one step at a time, a question about a top that has been watched a little, and its answer once the rest has
// been seen. Python has the steps in words, and the runs; a page that has them goes on by itself.
import { Curves } from "../lab/curves.js";
import { part } from "../lab/parts.js";
import { Time } from "../lab/time.js";
import { coalesce } from "../data.js";
import { Bar } from "./bar.js";
import { Graph } from "./graph.js";
import { Question } from "./question.js";
import { Stage } from "./stage.js";
import { style } from "./style.js";

const SECTIONS = ["derivation", "teach", "history"];
const NEARLY = 0.03; // s

class Lesson {
  /** @param {Rendering<LessonModel>} rendering */
  constructor({ model, el }) {
    const { texts } = model;
    this.model = model;
    this.texts = texts;
    this.count = 0;
    /** @type {Record<string, { guess?: string | number, asked?: boolean, done?: boolean, seen: number }>} */
    this.kept = {}; // of each step, as long as the page is open
    /** @type {Map<Bytes, Curves>} */
    this.read = new Map();
    this.time = new Time(coalesce(() => this.at()), "lesson");
    this.crumbs = part("ol", { class: "crumbs", "aria-label": texts.lesson.steps });
    this.heading = part("h2", { class: "question" });
    this.stage = new Stage(texts, this.time);
    this.bar = new Bar(texts, this.time);
    this.question = new Question(texts, {
      guess: (value) => this.guess(value), watch: () => this.watch(), next: () => this.go(1),
    });
    this.graph = new Graph(texts);
    this.more = part("nav", { class: "more", "aria-label": texts.lesson.more });
    this.element = part("div", { class: "lesson" }, this.crumbs, this.heading, this.stage.element, this.bar.element, this.question.element,
      this.graph.element, this.more);
    this.frame = part("div", { class: "frame" }, this.element);
    el.replaceChildren(part("style", {}, style), this.frame);
    this.look();
    this.show = coalesce(() => this.showNow());
  }

  look = () => {
    const look = document.documentElement.dataset.look ?? "";
    this.frame.dataset.look = look.startsWith("dark") ? "dark" : "light";
    this.frame.toggleAttribute("data-large", look.endsWith("large"));
    this.draw();
  };

  ask(name, value) {
    this.count += 1;
    this.model.asked = [this.count, name, value];
  }

  // Those of the part that is looked at: the lesson, or what is for theorists.
  get steps() {
    return this.model.steps.filter(({ theory }) => theory === this.step?.theory);
  }

  get record() {
    return (this.kept[this.step.name] ??= { seen: 0 });
  }

  go(by) {
    const next = this.steps[this.steps.indexOf(this.step) + by];
    if (next) this.open(next.name);
  }

  // A person goes to a step.
  open(name) {
    this.name = name;
    this.ask("step", name);
    this.showNow();
  }

  guess(value) {
    this.record.guess = value;
    this.showQuestion();
  }

  // The whole of it, from the beginning where it was watched before.
  watch() {
    const { record, step, time } = this;
    if (record.guess === undefined) return;
    if (record.done) time.again();
    record.asked = true;
    time.end = step.end;
    this.shown = undefined;
    this.showStep();
    time.play(true);
  }

  curvesOf(run) {
    if (!this.read.has(run.curves)) this.read.set(run.curves, new Curves(run.curves));
    return this.read.get(run.curves);
  }

  showNow() {
    const { model } = this, asked = model.state.step;
    if (!model.steps.length || !asked) return;
    if (asked !== this.told) this.name = this.told = asked; // Python's, a link's
    this.step = model.steps.find(({ name }) => name === this.name) ?? model.steps[0];
    if (this.step.name !== this.entered) this.enter();
    this.showStep();
  }

  // A step is begun: its beginning is played by itself, unless nothing is to move.
  enter() {
    const { step, time, record } = this, still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.entered = step.name;
    time.play(false);
    Object.assign(time, { end: record.asked ? step.end : step.before, events: step.events ?? [], chosen: step.speed ?? 0 });
    this.beginning = !still && !record.asked;
    this.frame.scrollIntoView?.({ block: "nearest" });
    time.seek(record.asked || still ? time.end : 0);
  }

  runs() {
    const { model, step } = this, all = { ...model.others, ...model.runs };
    const found = (step.tops ?? []).map(([name, word]) => ({ name, word, run: all[name], hidden: step.later.includes(name) && !this.record.asked }));
    return found.every(({ run }) => run) ? found : [];
  }

  showStep() {
    const { step, time, record } = this, tops = this.runs();
    this.frame.classList.toggle("waits", !tops.length);
    this.heading.innerHTML = step.question;
    this.showCrumbs();
    this.showQuestion();
    const shown = [step.name, record.asked, ...tops.map(({ run }) => run)];
    if (this.shown?.length === shown.length && shown.every((one, i) => one === this.shown[i])) return;
    this.shown = shown;
    if (tops.length) Object.assign(time, { unit: tops[0].run.seconds, tops: this.stage.tops });
    const curves = tops.map(({ run }) => this.curvesOf(run));
    this.stage.show(tops, step, curves);
    this.scene = { step, tops, curves, record };
    this.bar.show(this.scene);
    this.graph.show(this.scene);
    this.element.dataset.picture = this.graph.element.hidden ? "" : step.picture;
    if (!tops.length) return;
    time.seek(time.t);
    if (this.beginning) {
      this.beginning = false;
      time.play(true);
    }
    this.at();
  }

  showQuestion() {
    this.question.show(this.step, this.record, { playing: this.time.playing, last: this.steps.at(-1) === this.step });
  }

  showCrumbs() {
    const { texts: { lesson }, step } = this, places = this.steps;
    this.crumbs.replaceChildren(...places.map(({ name, title }, i) => {
      const done = this.kept[name]?.done;
      return part("li", {}, part("button", { type: "button", class: done ? "done" : "", "aria-current": name === step.name ? "step" : undefined, title, onclick: () => this.open(name) },
        part("b", {}, done && name !== step.name ? "✓" : String(i + 1)), part("span", {}, title)));
    }));
    const other = this.model.steps.find(({ theory }) => theory !== step.theory);
    this.more.replaceChildren(
      ...(other ? [this.link(step.theory ? lesson.home : lesson.sections.theory, () => this.open(other.name))] : []),
      ...SECTIONS.map((name) => this.link(lesson.sections[name], () => this.ask("section", name))));
  }

  link(word, onclick) {
    return part("button", { type: "button", class: "link", onclick }, word);
  }

  draw() {
    if (!this.scene) return;
    this.bar.draw();
    this.graph.draw();
    this.at();
  }

  at() {
    const { scene, time, record } = this;
    if (!scene?.tops.length) return;
    if (time.t > record.seen) record.seen = time.t;
    if (record.asked && !record.done && !time.playing && !time.held && time.t >= time.end - NEARLY) {
      record.done = true;
      this.showCrumbs();
      this.showQuestion();
    }
    this.question.plays(time.playing);
    this.stage.at(time.t);
    this.bar.at(time.t);
    this.graph.at(time.t);
  }

  leave() {
    this.show.cancel();
    for (const gone of [this.time, this.stage, this.bar, this.graph]) gone.leave();
    window.removeEventListener("tippe:look", this.look);
  }
}

/** @param {Rendering<LessonModel>} rendering */
export function renderLesson({ model, el, view }) {
  view.tippe?.dispose(); // Panel may build a view anew without saying "remove"
  const lesson = new Lesson({ model, el, view });
  for (const name of ["steps", "runs", "others", "state"]) model.on(name, lesson.show);
  window.addEventListener("tippe:look", lesson.look);
  lesson.show();
  view.tippe = { dispose: () => lesson.leave() };
  model.on("remove", () => lesson.leave());
}
