// The Lab: one top, one start, and the chosen table, or all three. Python solves and says what happened; this draws and
// plays it, and sends requests.
import { Answer, trackOf } from "./answer.js";
import { Asking } from "../controls/asking.js";
import { Before } from "./before.js";
import { Controls } from "./controls.js";
import { Curves, TABLES } from "../motion/curves.js";
import { Film } from "./film.js";
import { Flicking } from "./flick.js";
import { Keeps } from "./keeps.js";
import { numbersOf } from "./numbers.js";
import { part } from "../parts.js";
import { Sound } from "./sound.js";
import { Stage } from "./stage.js";
import { Strip } from "./strip.js";
import { style } from "./style.js";
import { Time } from "./time.js";
import { SHOWS } from "../three/top.js";
import { wordsOf } from "./words.js";
import { coalesce, debounce, float32 } from "../data.js";
import { atEnd, followLook, lifeOf } from "../life.js";
import { canBeFilmed } from "../motion/filmed.js";
import { Press } from "../widgets/press.js";

const TELL_MS = 80; // ms without a change of the time after which Python is told of it
const SAME = 1e-9; // s
const PATIENCE = 100; // ms that the old picture may be beside the new start without a remark

// A page without a server may have one tilt only.
const canTilt = ({ state }) => "tilt" in (JSON.parse(state).sliders ?? { tilt: true });

export class Lab {
  /** @param {Pick<Rendering<LabModel>, "model" | "el">} rendering @param {AbortSignal} life */
  constructor({ model, el }, life) {
    const { texts } = model;
    this.model = model;
    this.patience = this.since = 0;
    this.anew = "";
    /** @type {Record<string, { bytes: Bytes, curves: Curves }>} */
    this.bytes = {}; // the bytes that were read last, and the curves made from them
    /** @type {Record<string, any>} */
    this.state = {};
    this.time = new Time(coalesce(() => this.at(), life), life);
    this.asking = new Asking((...request) => (model.request = request));
    this.press = new Press(life);
    const ask = (name, value) => this.ask(name, value);
    this.sound = new Sound();
    this.before = new Before(texts);
    this.time.chose = (speed) => (model.speed = speed);
    this.flick = texts.lets_go ? new Flicking(this) : undefined; // a page without a server computes no new run
    this.stage = new Stage(texts, this.time, ask, { forget: () => this.forget(), hand: canTilt(model) ? this.hand() : undefined, flick: this.flick, camera: model.camera, life, set: (name, value) => (model[name] = value) });
    this.strip = new Strip(texts, this.time);
    this.words = wordsOf(texts, ask, () => this.goBack());
    this.answer = new Answer(texts, this.time, () => this.showLevel());
    this.keeps = new Keeps(texts);
    this.numbers = numbersOf(texts);
    this.controls = new Controls(texts, ask, () => this.anewSpin());
    this.controls.element.append(this.numbers.element);
    this.element = part("div", { class: "lab" }, this.stage.element, this.strip.element, this.words.element,
      this.answer.element, this.keeps.element, this.controls.element);
    this.frame = part("div", { class: "frame" }, this.element);
    for (const by of ["pointerdown", "keydown"]) this.strip.element.addEventListener(by, () => this.tells());
    el.replaceChildren(part("style", {}, style), this.frame);
    followLook(this.frame, life, () => {
      this.strip.draw();
      this.answer.draw();
    });
    this.show = coalesce(() => this.showNow(), life);
    this.tellSoon = debounce(() => this.tell(), TELL_MS, life);
    window.addEventListener("tippe:command", () => this.tells(), { signal: life });
    canBeFilmed(this, life);
    atEnd(life, () => {
      clearTimeout(this.patience);
      this.sound.leave();
    });
  }

  ask(name, value) {
    if (name === "table") {
      this.anew = value; // the same start on another table plays from its beginning
      this.stage.choice.show(value);
    }
    this.before.touch(name, this.scene, this.press.now);
    this.asking.ask(name, value);
    this.patience ||= setTimeout(() => this.show(), PATIENCE);
  }

  // Names what an old picture shows, if it must be named.
  old() {
    const { state } = this, waits = this.asking.isAhead || state.busy;
    if (!waits) {
      clearTimeout(this.patience);
      this.patience = this.since = 0;
    } else this.since ||= performance.now();
    if (waits) this.patience ||= setTimeout(() => this.show(), PATIENCE);
    this.waits = !state.old && waits && performance.now() - this.since >= PATIENCE - 1 && Boolean(state.was);
    return state.old || (this.waits ? state.was : "");
  }

  // Dismisses the earlier run, or goes back to it.
  forget() {
    this.before.forget();
    this.showNow();
  }

  goBack() {
    this.before.goBack((name, value) => this.ask(name, value), this.scene);
  }

  // A person has set the time: from now on Python is told of it.
  tells() {
    this.isTold = true;
  }

  // Tells Python whether it plays, and the time at which it rests.
  tell() {
    const { model, time } = this, t = time.t / time.unit;
    if (!this.scene || time.held) return;
    this.isTelling = true;
    if (model.playing !== time.playing) model.playing = time.playing;
    if (!time.playing && model.time !== t) model.time = t;
    this.isTelling = false;
  }

  // Sets how much is open, what is shown on the stage, and how fast it plays.
  showLevel = () => {
    const { model, element, stage, time } = this, isOpen = model.level === "research";
    element.dataset.level = model.level;
    time.chosen = model.speed;
    stage.dress(model, isOpen, this.answer.name === "trace");
    this.show();
  };

  // Dragging the axis: the motion starts again at that tilt when the pointer is released.
  hand() {
    return {
      pull: (degrees) => {
        if (this.time.playing || this.time.t) {
          this.time.play(false);
          this.time.seek(0);
        }
        this.ask("tilt", Number(degrees.toFixed(1)));
      },
      letGo: () => this.spin(),
    };
  }

  // Let go by a hand anew, nothing pushes it.
  anewSpin() {
    if (this.scene?.state.of.pushes[0]) this.ask("pushes", "");
    this.spin();
  }

  spin() {
    this.time.again();
    this.time.play(true);
  }

  // Reads what Python sent.
  read() {
    const { model } = this, { table, runs } = this.state, state = Object.assign({}, this.state, { old: this.old() });
    const each = (read) => Object.fromEntries(TABLES.map((name) => [name, read(name)]));
    for (const name of TABLES) {
      const bytes = model[`curves_${name}`];
      if (!this.bytes[name] || this.bytes[name].bytes !== bytes) this.bytes[name] = { bytes, curves: new Curves(bytes) };
    }
    const alone = table === "three" ? "ordinary" : table, curves = each((name) => this.bytes[name].curves);
    return {
      state, texts: model.texts, isOpen: model.level === "research", table, curves, runs, run: runs[alone], unit: model.seconds, a: model.a,
      frames: each((name) => model[`frames_${name}`]), profile: float32(model.profile),
      end: Math.max(...Object.values(curves).map(({ end }) => end)), waits: this.waits,
      keeps: each((name) => model[`keeps_${name}`]),
      track: (name) => trackOf(model[`frames_${name}`], model.seconds),
    };
  }

  showNow() {
    this.state = { ...JSON.parse(this.model.told), ...JSON.parse(this.model.state) };
    if (!this.state.runs) return; // Python has not sent any runs yet
    const scene = this.read(), { time, model } = this;
    this.asking.hear(this.state.answered);
    scene.before = this.before.follow(this.scene, scene, !this.asking.isAhead && !this.state.busy);
    this.scene = scene;
    Object.assign(time, { unit: model.seconds, end: scene.end, events: scene.run?.events ?? [], tops: this.stage.tops });
    time.span = scene.state.whole ? scene.end : Math.max(scene.end, time.span); // an axis must not change while it is dragged
    this.element.dataset.table = scene.table;
    scene.bytes = model.profile;
    this.stage.show(scene);
    this.sound.show(scene);
    for (const shown of [this.strip, this.words, this.answer, this.keeps, this.numbers]) shown.show(scene);
    this.controls.show(scene, this.asking.isAhead);
    if (!this.isBegun && scene.end) this.begin();
    this.element.toggleAttribute("data-whole", Boolean(scene.state.whole)); // for tests only
    this.element.classList.toggle("old", Boolean(scene.state.old));
    this.flick?.answered();
    if (this.anew === scene.table) {
      this.anew = "";
      this.spin();
    }
    this.at();
  }

  film = () => new Film(this);

  // Python sets whether it plays, and when.
  hear() {
    const { model, time } = this, t = model.time * time.unit;
    if (!this.isBegun || this.isTelling) return;
    if (model.playing !== time.playing) time.play(model.playing);
    if (!model.playing && Math.abs(t - time.t) > SAME) time.seek(t);
  }

  // A link may be of one moment.
  begin() {
    const { model, time } = this;
    this.isBegun = true;
    if (model.playing) return;
    time.seek(model.time * time.unit);
    time.play(false);
  }

  at() {
    if (!this.scene) return;
    // While it plays the time never rests: that it plays is told at once, or a link would keep the moment before.
    if (this.isTold && this.time.playing) this.tell();
    else if (this.isTold) this.tellSoon();
    this.sound.at(this.time.t, this.time.playing && !this.time.held);
    for (const shown of [this.stage, this.strip, this.words, this.answer, this.keeps, this.numbers]) shown.at(this.time.t);
  }
}

/** @param {Rendering<LabModel>} rendering */
export function renderLab(rendering) {
  const { model } = rendering, life = lifeOf(rendering, { hold: (held) => lab.asking.hold(held) }), lab = new Lab(rendering, life);
  for (const name of ["state", "told", "profile", "a", "seconds", ...TABLES.flatMap((table) => [`frames_${table}`, `curves_${table}`, `keeps_${table}`])]) {
    model.on(name, lab.show);
  }
  for (const name of ["level", "speed", ...SHOWS]) model.on(name, lab.showLevel);
  for (const name of ["time", "playing"]) model.on(name, () => lab.hear());
  lab.showLevel();
}
