// The tops of a step, side by side, with their names below, and what the first one is doing.
import { latest, TILT } from "../motion/curves.js";
import { drawn, part, say } from "../parts.js";
import { Top } from "../three/top.js";
import { Ways } from "./ways.js";

const MOST = 3;
export const DASHES = ["", "7 4", "2 4"]; // stroke patterns of their curves

export class Stage {
  /** @param {Record<string, any>} texts @param {import("../lab/time.js").Time} time @param {AbortSignal} life */
  constructor(texts, time, life) {
    this.texts = texts;
    this.step = /** @type {any} */ ({});
    /** @type {any[]} */
    this.curves = [];
    /** @type {any[]} */
    this.shown = [];
    this.time = time;
    this.heard = ""; // what was said of them last
    // a single top is drawn close, several a little farther away
    this.tops = Array.from({ length: 1 + MOST }, (_, i) => new Top({ texts, time, life, label: texts.stage, away: i ? 1.5 : 1.3 }));
    this.captions = this.tops.map(() => part("p", { class: "caption" }));
    this.covers = this.tops.map(() => part("p", { class: "cover" }, texts.lesson.later));
    this.places = this.tops.map((top, i) => part("div", { class: "place" }, top.element, this.captions[i], this.covers[i]));
    this.pill = part("div", { class: "pill" });
    this.ways = new Ways(texts);
    this.wait = part("p", { class: "wait", role: "status" });
    this.element = part("section", { class: "stage", "aria-label": texts.stage }, part("div", { class: "tops" }, ...this.places), this.pill, this.ways.element, this.wait);
  }

  /** @param {any[]} tops @param {any} step @param {any[]} curves @param {boolean} isAsked whether the person has guessed */
  show(tops, step, curves, isAsked) {
    const { lesson } = this.texts;
    this.step = step;
    this.isAsked = isAsked;
    this.curves = curves;
    this.shown = tops;
    this.heard = "";
    this.ways.element.hidden = step.picture !== "spin" || !tops.length;
    this.wait.textContent = tops.length ? "" : step.refused ? `${lesson.wrong} ${step.refused}` : lesson.wait;
    this.tops.forEach((top, i) => {
      const found = tops.length > 1 ? tops[i - 1] : tops[i];
      this.places[i].hidden = !found;
      this.covers[i].hidden = !found?.hidden;
      if (!found) return top.put({ frames: null });
      const { run, word, hidden } = found;
      top.put({ profile: run.profile, a: run.a, seconds: run.seconds, frames: hidden ? null : run.frames });
      this.captions[i].hidden = tops.length < 2;
      this.captions[i].replaceChildren(drawn("svg", { viewBox: "0 0 26 8", width: 26, height: 8, "aria-hidden": "true" },
        drawn("path", { d: "M0 4h26", stroke: "currentColor", "stroke-width": 2.2, "stroke-dasharray": DASHES[i - 1] || undefined })), ` ${word}`);
      if (this.element.isConnected) top.begin();
    });
  }

  /** @param {number} t */
  at(t) {
    const { step, shown, time, curves, texts } = this, words = shown.map(({ name }) => latest(step.stages?.[name] ?? [], t)?.[1]), isOne = shown.length === 1;
    this.pill.hidden = !isOne || !words[0];
    if (!this.ways.element.hidden) this.ways.at(curves[0], t);
    if (isOne) this.pill.textContent = this.wording(words[0], curves[0], t);
    const news = time.playing ? words.join() : String(t);
    if (news === this.heard) return;
    this.heard = news;
    shown.forEach(({ word, hidden }, i) => this.tops[isOne ? 0 : i + 1].describe(`${isOne ? "" : `${word}: `}${hidden ? texts.lesson.later : this.wording(words[i], curves[i], t)}`));
  }

  // What a top does, and how far it leans; before the guess its tilt alone, because the word gives the answer away.
  wording(word, curves, t) {
    const { texts, isAsked } = this;
    return say(texts, word && isAsked ? texts.lesson.pill : texts.lesson.pill_before, { word, tilt: [curves.at(t, TILT), 0] });
  }
}
