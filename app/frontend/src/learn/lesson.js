// The lesson, step by step: a question about a top after a short look at it, and the answer after the rest of the run.
// Python sends the words and the runs; once they are there, the page needs no server.
import { follow, followLook, lifeOf } from "../life.js";
import { Curves } from "../motion/curves.js";
import { part } from "../parts.js";
import { Time } from "../lab/time.js";
import { ask, coalesce } from "../data.js";
import { Bar } from "./bar.js";
import { Graph } from "./graph.js";
import { phoneSide } from "./phone_side.js";
import { hideOthers, Presenter, wishOf } from "./present.js";
import { Question } from "./question.js";
import { Stage } from "./stage.js";
import { style } from "./style.js";
import { isWriting } from "../widgets/press.js";
import { save } from "../widgets/saving.js";

const SECTIONS = ["derivation", "published", "teach", "history"];
const NEARLY = 0.03, LONG = 3; // s: this close to the end counts as the end; a longer rest can be skipped

class Lesson {
  /** @param {Rendering<LessonModel>} rendering */
  constructor(rendering) {
    const { model, el } = rendering, { texts } = model, life = lifeOf(rendering);
    this.model = model;
    this.texts = texts;
    this.count = 0;
    /** @type {Record<string, { guess?: string | number, requested?: boolean, done?: boolean, seen: number }>} */
    this.kept = {}; // by step, as long as the page is open
    /** @type {Map<Bytes, Curves>} */
    this.read = new Map();
    this.time = new Time(coalesce(() => this.at(), life), life, "lesson");
    this.crumbs = part("ol", { class: "crumbs", "aria-label": texts.lesson.steps });
    this.heading = part("h2", { class: "question" });
    this.stage = new Stage(texts, this.time, life);
    this.bar = new Bar(texts, this.time);
    this.question = new Question(texts, {
      guess: (value) => this.guess(value), watch: () => this.watch(), skip: () => this.skip(), next: () => this.go(1), lab: () => this.ask("lab", ""),
    });
    this.graph = new Graph(texts);
    this.presenting = this.lost = this.back = false;
    this.presenter = new Presenter(texts, (wish) => this.does(wish));
    this.phone = phoneSide(texts, (name, value) => this.ask(name, value), () => this.replay());
    this.more = part("nav", { class: "more", "aria-label": texts.lesson.more });
    this.right = part("div", { class: "right" }, this.question.element, this.graph.element);
    this.element = part("div", { class: "lesson" }, this.crumbs, this.heading, this.stage.element, this.bar.element, this.right,
      this.presenter.board, this.presenter.foot, this.phone.head, this.phone.foot, this.phone.follows, this.more);
    this.frame = part("div", { class: "frame", tabindex: -1 }, this.element);
    el.replaceChildren(part("style", {}, style), this.frame);
    followLook(this.frame, life, () => this.draw());
    this.show = coalesce(() => this.showNow(), life);
    this.listen(life);
  }

  /** @param {AbortSignal} signal its life */
  listen(signal) {
    window.addEventListener("tippe:lost", this.onLost, { signal });
    window.addEventListener("tippe:back", this.onLost, { signal });
    // captured before a focused tab of the head can use an arrow key for itself
    window.addEventListener("keydown", this.onKey, { signal, capture: true });
    document.addEventListener("fullscreenchange", this.onScreen, { signal });
  }

  ask(name, value) {
    this.count += 1;
    ask(this.model, [this.count, name, value]);
  }

  // The steps of the part that is shown: the lesson, or the part for theorists.
  get steps() { return this.model.steps.filter(({ theory }) => theory === this.step?.theory); }

  get record() { return (this.kept[this.step.name] ??= { seen: 0 }); }

  go(by) {
    const next = this.steps[this.steps.indexOf(this.step) + by];
    if (next) this.open(next.name);
  }

  // A person chooses a step.
  open(name) {
    this.name = name;
    this.ask("step", name);
    this.showNow();
  }

  guess(value) {
    this.record.guess = value;
    if (this.role === "phone") this.ask("vote", value);
    this.showQuestion();
  }

  get role() { return this.model.state.role ?? ""; }

  get room() { return this.model.state.room ?? {}; }

  // ---- in front of a class ----

  onKey = (event) => {
    if (this.role === "phone" || !this.frame.getClientRects().length || isWriting(event)) return;
    const wish = wishOf(event, this.presenting);
    if (!wish) return;
    event.preventDefault();
    event.stopPropagation();
    this.does(wish);
  };

  does(wish) {
    if (!this.step) return;
    const { time } = this;
    if (wish === "present") this.present(true);
    else if (wish === "leave") this.present(false);
    else if (wish === "on" || wish === "back") this.go(wish === "on" ? 1 : -1);
    else if (wish === "play") time.play(!time.playing);
    else if (wish === "reveal") this.reveal();
    else {
      this.kept = {};
      this.entered = undefined;
      this.ask("reset", "");
      this.open(this.steps[0].name);
    }
  }

  // A class sees the question alone; either the frame itself fills the window, or it fills the whole screen.
  present(presenting) {
    if (this.presenting === presenting) return;
    this.presenting = presenting;
    hideOthers(this.frame, presenting);
    this.frame.classList.toggle("presenting", presenting);
    this.element.classList.toggle("present", presenting);
    if (presenting) {
      this.frame.focus({ preventScroll: true });
      document.documentElement.requestFullscreen?.().catch(() => {});
      if (!this.room.code) this.ask("present", "");
    } else if (document.fullscreenElement) document.exitFullscreen();
    this.shown = undefined;
    this.showNow();
  }

  onScreen = () => {
    if (this.presenting && !document.fullscreenElement && this.wasFull) this.present(false);
    this.wasFull = Boolean(document.fullscreenElement);
  };

  reveal() {
    const { record } = this;
    if (record.requested || !this.step.asks) return;
    record.guess ??= NaN;
    this.ask("reveal", "");
    this.watch();
  }

  // The lesson goes on without the server; the person at the screen chooses when to reload the page.
  onLost = (event) => {
    if (!this.presenting) return;
    event.preventDefault();
    [this.lost, this.back] = [event.type === "tippe:lost", event.type === "tippe:back"];
    this.showQuestion();
  };

  replay() {
    this.time.again();
    this.time.play(true);
  }

  // Plays the whole run, from the beginning if it has been watched before.
  watch() {
    const { record, step, time } = this;
    if (record.guess === undefined) return;
    if (record.done) time.again();
    record.requested = true;
    time.end = step.end;
    this.shown = undefined;
    this.showStep();
    time.play(true);
  }

  // What decides the answer has been seen; the rest can be skipped.
  skip() {
    this.time.play(false);
    this.time.seek(this.time.end);
  }

  curvesOf(run) {
    if (!this.read.has(run.curves)) this.read.set(run.curves, new Curves(run.curves));
    return this.read.get(run.curves);
  }

  showNow() {
    const { model } = this, requested = model.state.step;
    if (this.role === "phone") this.phone.put(model.state);
    if (!model.steps.length || !requested) return;
    if (model.state.presents && model.state.presents !== this.presents) {
      this.presents = model.state.presents;
      setTimeout(() => this.present(true));
    }
    if (requested !== this.told) this.name = this.told = requested; // Python's wish, from a link
    this.step = model.steps.find(({ name }) => name === this.name) ?? model.steps[0];
    if (this.role === "phone") this.follow();
    if (this.step.name !== this.entered) this.enter();
    this.showStep();
  }

  // A phone shows the answer when the big screen does.
  follow() {
    const { room, step } = this, mine = room.question === step.name ? room.mine : undefined;
    this.element.dataset.role = "phone";
    if (this.requested !== step.name) delete this.kept[step.name];
    this.requested = step.name;
    if (mine !== undefined && mine !== null) this.record.guess = mine;
    if (room.question === step.name && room.shown && step.told.length && !this.record.requested) {
      this.record.guess ??= NaN;
      this.watch();
    }
  }

  // Starts a step: its beginning plays by itself, unless the system asks for reduced motion.
  enter() {
    const { step, time, record } = this, still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.entered = step.name;
    time.play(false);
    Object.assign(time, { end: record.requested ? step.end : step.before, events: step.events ?? [], chosen: step.speed ?? 0 });
    this.beginning = !still && !record.requested;
    this.frame.scrollIntoView?.({ block: "start" });
    time.seek(record.requested || still ? time.end : 0);
  }

  runs() {
    const { model, step } = this, all = { ...model.others, ...model.runs };
    const found = (step.tops ?? []).map(([name, word]) => ({ name, word, run: all[name], hidden: step.later.includes(name) && !this.record.requested }));
    return found.every(({ run }) => run) ? found : [];
  }

  showStep() {
    const { step, time, record } = this, tops = this.runs();
    this.frame.classList.toggle("waits", !tops.length);
    this.heading.innerHTML = step.question;
    this.showCrumbs();
    this.showQuestion();
    const shown = [step.name, record.requested, this.presenting, ...tops.map(({ run }) => run)];
    if (this.shown?.length === shown.length && shown.every((one, i) => one === this.shown[i])) return;
    this.shown = shown;
    if (tops.length) Object.assign(time, { unit: tops[0].run.seconds, tops: this.stage.tops });
    const curves = tops.map(({ run }) => this.curvesOf(run)), { t } = time; // a top that is drawn for the first time starts at 0
    this.stage.show(tops, step, curves, Boolean(record.requested));
    this.scene = { step, tops, curves, record, inClass: this.presenting };
    this.bar.show(this.scene);
    this.graph.show(this.scene);
    this.putPicture();
    if (!tops.length) return;
    time.seek(t);
    if (this.beginning) {
      this.beginning = false;
      time.play(true);
    }
    this.at();
  }

  // The picture beside the question. The lever arms replace the top if that fills the screen or the page is narrow; in
  // front of a class, a graph appears with the answer, where the code was.
  putPicture() {
    const { graph, presenting, presenter, record } = this, kind = graph.element.hidden ? "" : graph.kind;
    const place = !presenting ? this.right : kind === "arms" ? this.element : presenter.board;
    if (graph.element.parentElement !== place) place.insertBefore(graph.element, place === presenter.board ? presenter.code : null);
    this.element.dataset.picture = kind;
    this.element.toggleAttribute("data-answered", Boolean(record.done));
    graph.draw();
  }

  showQuestion() {
    const { steps, step, record, lost, back } = this, last = steps.at(-1) === step;
    const learned = last && !step.theory ? steps.map((each) => each.learned).filter(Boolean) : [];
    this.question.show(step, record, { playing: this.time.playing, last, learned });
    if (this.presenting) this.presenter.put(step, record, this.room, { steps, lost, back });
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
      ...(lesson.sections.theory ? [this.link(step.theory ? lesson.home : lesson.sections.theory, () => other && this.open(other.name))] : []),
      ...SECTIONS.filter((name) => lesson.sections[name]).map((name) => this.link(lesson.sections[name], () => this.ask("section", name))),
      this.link(lesson.worksheet, () => this.paper()), this.link(lesson.room.present, () => this.present(true)));
  }

  link(word, onclick) { return part("button", { type: "button", class: "link", onclick }, word); }

  // Opens a page to print in a new window, or saves it where there may be none; it needs no server.
  paper() {
    const page = new Blob([this.model.worksheet], { type: "text/html" });
    window.open(URL.createObjectURL(page), "_blank") ?? save(page, "tippe-top-sheet.html");
  }

  draw() {
    if (!this.scene) return;
    this.bar.draw();
    this.graph.draw();
    this.at();
  }

  at() {
    const { scene, time, record, step } = this;
    if (!scene?.tops.length) return;
    if (time.t > record.seen) record.seen = time.t;
    if (record.requested && !record.done && !time.playing && !time.held && time.t >= time.end - NEARLY) {
      record.done = true;
      this.putPicture();
      this.showCrumbs();
      this.showQuestion();
    }
    this.question.plays(time.playing, step.events[1]?.[0] < time.t && time.end - time.t > LONG);
    this.stage.at(time.t);
    this.bar.at(time.t);
    this.graph.at(time.t);
  }
}

/** @param {Rendering<LessonModel>} rendering */
export function renderLesson(rendering) {
  follow(rendering.model, ["steps", "runs", "others", "state"], new Lesson(rendering).show);
}
