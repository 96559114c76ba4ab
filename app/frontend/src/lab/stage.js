// The large picture: one top or three on their tables, with the switch of tables, the name of the top, what it is
// doing, and how fast it turns.
import { thenAt } from "./before.js";
import { latest, TABLES, TILT, TURNING } from "../motion/curves.js";
import { pushesIn } from "./flick.js";
import { Choice, drawn, part, say } from "../parts.js";
import { toldOf } from "./told.js";
import { SPEEDS } from "./time.js";
import { ARROWS, NOTHING, SHOWS, Top } from "../three/top.js";

const RING = "M18 14c-9 1.500-15 3.500-15 6 0 5 25 9 57 9 25 0 47-2.500 56-6";

export class Stage {
  /**
   * @param {Record<string, any>} texts
   * @param {import("./time.js").Time} time
   * @param {(name: string, value: any) => void} ask
   * @param {{ forget?: () => void, hand?: { pull(degrees: number): void, letGo(): void }, flick?: Hand, camera: number[], life: AbortSignal, set?: (name: string, value: any) => void }} of
   *     forget: dismisses the earlier run; camera: the chosen view, or empty; set: sets it, and what is shown
   */
  constructor(texts, time, ask, { forget, hand, flick, camera, life, set = () => {} }) {
    this.texts = texts;
    this.time = time;
    /** @type {Record<string, HTMLElement>} */
    this.lines = {}; // below three tops: what each of them does
    const words = { ...texts, hint: [texts.flick_hint, texts.turn_hint].filter(Boolean).join(" "), handle: texts.axis, handle_hint: texts.axis_hint };
    this.alone = new Top({ texts: words, time, life, label: texts.stage, away: 1.3, hand, flick, camera, turned: (chosen) => set("camera", chosen) });
    this.three = TABLES.map((table) => new Top({ texts, time, life, label: texts.labels[table], away: 1.75, flick }));
    this.captions = TABLES.map(() => part("p", { class: "caption" }));
    this.places = [part("div", { class: "place" }, this.alone.element),
      ...this.three.map((top, i) => part("div", { class: "place" }, top.element, this.captions[i]))];
    this.choice = new Choice({
      role: "radio", label: texts.table, kind: "seg", choose: (table) => ask("table", table),
      options: [...TABLES, "three"].map((name) => [name, texts.tables[name], texts.hints[name]]),
    });
    this.pill = part("div", { class: "pill" });
    this.turns = part("span");
    this.ring = part("div", { class: "ring" }, drawn("svg", { viewBox: "0 0 130 34", "aria-hidden": "true" },
      drawn("path", { d: RING, fill: "none", stroke: "currentColor", "stroke-width": 3, "stroke-linecap": "round" }),
      drawn("path", { d: "M128 19l-16 9-1-13z", fill: "currentColor" })), this.turns);
    this.then = part("span", { class: "whole" });
    this.briefly = part("span", { class: "brief" });
    this.chip = part("div", { class: "chip", hidden: true }, this.then, this.briefly,
      part("button", { type: "button", "aria-label": texts.forget, title: texts.forget, onclick: forget }, "×"));
    this.boxes = SHOWS.map((name) => part("input", { type: "checkbox", name, onchange: (event) => set(name, event.target.checked) }));
    this.menu = part("details", { class: "shows" }, part("summary", {}, texts.show), part("div", { class: "list" }, ...SHOWS.map((name, i) => {
      const label = part("label", { title: texts.shows[name][1] }, this.boxes[i], part("span")); // the title is its name in full
      label.lastChild.innerHTML = texts.shows[name][0];
      this.boxes[i].setAttribute("aria-label", texts.shows[name][1]);
      return label;
    }), part("button", { type: "button", onclick: () => this.alone.firstView() }, texts.view)));
    this.missing = part("p", { class: "missing", role: "status" });
    this.told = toldOf(texts, time, life, (told) => this.tops.forEach((top, i) => top.describe(told[i] ?? "")));
    this.element = part("section", { class: "stage", "aria-label": texts.stage },
      part("div", { class: "tops" }, ...this.places), this.ring,
      part("div", { class: "on" }, part("div", { class: "switch" }, part("b", {}, texts.table), this.choice.element)),
      this.pill, this.chip, this.menu, this.missing, this.told.element);
  }

  // Shows what of a motion is to be shown, and the chosen view; nothing but the top unless all of it is open, and the
  // trace on the ball beside its map.
  /** @param {LabModel} model @param {boolean} isOpen @param {boolean} isMapped */
  dress(model, isOpen, isMapped) {
    const shown = isOpen ? Object.fromEntries(SHOWS.map((name) => [name, model[name]])) : { ...NOTHING, show_trace: isMapped };
    for (const top of this.tops) {
      top.put(shown);
      top.element.toggleAttribute("data-arrows", ARROWS.some((name) => shown[name]));
    }
    this.boxes.forEach((box) => (box.checked = model[box.name]));
    this.menu.hidden = !isOpen;
  }

  get tops() { return [this.alone, ...this.three]; }

  show(scene) {
    const { state, texts, table } = scene, three = table === "three";
    this.scene = scene;
    this.choice.show(table);
    this.told.show(scene);
    const { bytes: profile, a, unit: seconds, before } = scene, pushes = pushesIn(texts, state);
    this.tops.forEach((top, i) => {
      const shown = three === i > 0;
      this.places[i].hidden = !shown;
      if (!shown) return top.put({ frames: null }); // a stage without frames costs nothing
      const was = !i && before ? { frames: before.frames[before.table], profile: before.bytes, a: before.a, seconds: before.unit } : null;
      if (was?.frames !== top.model.before?.frames) top.put({ before: was });
      top.put({ profile, a, seconds, pushes, frames: scene.frames[three ? TABLES[i - 1] : table] });
      if (this.element.isConnected) top.begin();
    });
    TABLES.forEach((name, i) => this.captions[i].replaceChildren(...(three ? this.caption(name) : [])));
    const why = (three ? "" : scene.runs[table]?.why ?? "") || (state.messages.pushes ?? "");
    this.missing.textContent = why;
    this.missing.hidden = !why;
    this.old = state.old ? say(texts, texts.old, { what: state.old }) : "";
  }

  caption(name) {
    const { texts } = this;
    this.lines[name] = part("span", { class: "does" });
    return [part("b", {}, texts.tables[name]), ` ${texts.hints[name]}`, part("br"), this.lines[name]];
  }

  // The earlier run in words.
  /** @param {number} t */
  beforeAt(t) {
    const { scene: { before }, texts, chip, then, briefly } = this, shown = Boolean(before?.curves[before.table].count);
    chip.hidden = !shown;
    if (!shown) return;
    const numbers = { what: before.what, tilt: [thenAt(before, t, TILT), 0] };
    [then.textContent, briefly.textContent] = [texts.before, texts.before_brief].map((text) => say(texts, text, numbers));
  }

  /** @param {number} t */
  at(t) {
    this.beforeAt(t);
    this.told.at(t);
    const { scene, texts } = this, three = scene.table === "three";
    const curves = scene.curves[three ? "ordinary" : scene.table], run = scene.runs[three ? "ordinary" : scene.table];
    this.pill.hidden = three || !curves.count;
    this.ring.hidden = three || !curves.count;
    if (three) {
      for (const name of TABLES) {
        const [, , , does] = latest(scene.runs[name]?.stages ?? [], t) ?? [];
        this.lines[name].textContent = scene.runs[name]?.why || scene.runs[name]?.caption || (does ?? "");
      }
    } else if (curves.count) {
      const [, , , word] = latest(run.stages, t) ?? [], tilt = [curves.at(t, TILT), 0];
      const turning = curves.at(t, TURNING), most = Math.abs(turning);
      const { fast } = this.time, speed = texts.speeds[SPEEDS.indexOf(fast)];
      this.pill.textContent = this.old || say(texts, fast ? texts.pill_fast : texts.pill, { word: word ?? "", tilt, speed });
      this.turns.textContent = say(texts, texts.turns, { turns: [most, most < 9.95 ? 1 : 0] });
      this.ring.classList.toggle("back", turning < 0);
      this.ring.hidden = most < 0.05;
    }
  }
}
