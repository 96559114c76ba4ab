// The time, and the tilt as far as it has been seen: play, and drag anywhere. What comes after the guess is hidden.
import { digitsOf, ticks, TILT } from "../motion/curves.js";
import { FOOT, LEFT, levels, marks, TimeLine, times } from "../figures/line.js";
import { drawn, part, say } from "../parts.js";
import { DASHES } from "./stage.js";

const TOP = 20, LETTER = 6.6; // px

export class Bar extends TimeLine {
  /** @param {Record<string, any>} texts @param {import("../lab/time.js").Time} time */
  constructor(texts, time) {
    super(texts, time, { label: texts.lesson.time, step: "any" });
    this.note = part("p", { class: "small" });
    this.element = part("section", { class: "bar timeline", "aria-label": texts.lesson.bar }, this.play, this.plot, this.note);
  }

  get whole() { return this.scene.step.end; }

  show(scene) {
    this.scene = scene;
    this.element.classList.toggle("none", !scene.tops.length);
    this.draw();
  }

  // The range of degrees that is drawn: all of them if the top turns over, otherwise those of the run.
  span() {
    const { step, curves } = this.scene;
    if (!step.speed) return [0, 180];
    const [least, most] = curves[0].range(TILT);
    return [Math.floor(least / 5) * 5, Math.ceil(most / 5) * 5];
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.plot, { scene, time } = this;
    if (!width || !scene?.tops.length) return;
    const { curves, tops, record } = scene, [low, high] = this.span();
    Object.assign(this, { width, bottom: height - FOOT });
    const y = (tilt) => this.bottom - ((this.bottom - TOP) * (tilt - low)) / (high - low);
    const lines = tops.flatMap(({ hidden }, i) => hidden ? [] : [[curves[i].points(this.x, y, TILT), DASHES[i]]]);
    const line = (kind) => lines.map(([points, dash]) => drawn("polyline", { class: kind, points, "stroke-dasharray": dash || undefined }));
    this.played = drawn("rect", { x: 0, y: 0, width: 0, height });
    this.seen = drawn("rect", { x: 0, y: 0, width: 0, height });
    this.cover = record.requested ? [] : this.covered();
    this.drawing.replaceChildren(
      drawn("clipPath", { id: "lesson-played" }, this.played), drawn("clipPath", { id: "lesson-seen" }, this.seen),
      ...this.axes(y, low === 0 && high === 180 ? [0, 90, 180] : ticks(low, high, 3)),
      drawn("g", { "clip-path": "url(#lesson-seen)" }, ...line("rest")), drawn("g", { "clip-path": "url(#lesson-played)" }, ...line("past")), ...this.cover,
      ...(this.marks = this.events()),
    );
    this.drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.range.max = String(time.end);
    this.at(time.t);
  }

  covered() {
    const { texts: { lesson } } = this, x = this.x(this.time.end), wide = this.right - x;
    const word = this.scene.inClass ? lesson.rest_votes : lesson.rest;
    return [drawn("rect", { class: "covered", x, y: TOP - 6, width: Math.max(wide, 0), height: this.bottom - TOP + 6 }),
      drawn("text", { class: "word", x: x + wide / 2, y: (TOP + this.bottom) / 2, "text-anchor": "middle" }, wide > LETTER * word.length ? word : "")];
  }

  axes(y, tilts) {
    const { width, right, whole, texts } = this, along = ticks(0, whole, Math.min(6, width / 60));
    return [...levels(tilts, { y, left: LEFT, right }, (tilt) => `${tilt}°`, tilts[0]), ...marks(along, this, times(texts, digitsOf(along)))];
  }

  // What happened and when, as far as it has been seen.
  events() {
    const { scene: { step, tops }, texts } = this;
    if (tops.length > 1) return [];
    let free = LEFT - 14; // there is room beside the highest number on the axis
    return step.events.filter(([t]) => t <= step.end).flatMap(([t, , , short]) => {
      const word = `${short} ${say(texts, "{t} s", { t: [t, 1] })}`, x = this.x(t), wide = LETTER * word.length;
      const side = x - wide - 8 > free ? "end" : "start", from = side === "end" ? x - wide - 5 : x + 5;
      if (from < free || from + wide > this.width) return [];
      free = from + wide + 8;
      const mark = drawn("g", {}, drawn("line", { class: "event", x1: x, x2: x, y1: 4, y2: this.bottom }),
        drawn("text", { x: side === "start" ? x + 5 : x - 5, y: 12, "text-anchor": side }, word));
      mark.dataset.t = String(t);
      return [mark];
    });
  }

  /** @param {number} t */
  at(t) {
    const { time, texts, scene } = this;
    if (!this.width || !scene?.tops.length) return;
    const x = this.move(t), seen = Math.min(scene.record.seen, time.end);
    this.played.setAttribute("width", String(Math.max(x, 0)));
    this.seen.setAttribute("width", String(Math.max(this.x(seen), 0)));
    for (const mark of this.marks) mark.style.display = Number(mark.dataset.t) <= seen + 1e-6 ? "" : "none";
    const tilt = scene.curves[0].at(t, TILT), digits = scene.step.speed ? 3 : 2;
    this.range.setAttribute("aria-valuetext", say(texts, texts.time_says, { t: [t, digits], tilt: [tilt, 0], headline: "" }));
    const stopped = !scene.record.requested && !time.playing && t > time.end - 0.03 * this.whole;
    this.note.textContent = stopped ? say(texts, texts.lesson.before, { t: [time.end, digits] }) : "";
  }
}
