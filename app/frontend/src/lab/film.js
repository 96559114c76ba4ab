// The Lab's stage, line and words once more, out of sight and on a clock of their own, for a film: each picture is drawn
// for its own time, however long that takes, while the page goes on.
import { Stage } from "./stage.js";
import { Strip } from "./strip.js";
import { style } from "./style.js";
import { SPEEDS, Time } from "./time.js";
import { wordsOf } from "./words.js";
import { penOf } from "../data.js";
import { followLook } from "../life.js";
import { filmedOn } from "../motion/clock.js";
import { HIGH, WIDE } from "../motion/filmed.js";
import { imageOf, paintBox, paintWords } from "../paint.js";
import { part } from "../parts.js";

const CLOCK = "film";
const STYLE = `${style} .film { position: fixed; left: -9999px; top: 0; visibility: hidden; width: ${WIDE}px; height: ${HIGH}px; }
.film .lab.lab.lab { display: grid; height: 100%; padding: 0; gap: 8px; grid-template: "stage" minmax(0, 1fr) "strip" 148px "say" 116px / 100%; }
.film .stage { height: auto; border-radius: 0; } .film .strip { grid-template-columns: 72px minmax(0, 1fr) 130px; } .film :is(.strip, .say) { padding: 0 24px; }
.film :is(.on, .shows, .round, .speed, .again, .outline, .link, .chip button) { display: none; } .film .chip { padding: 4px 12px; } .film .say p { max-width: none; }`;

export class Film {
  /** @type {HTMLImageElement[]} */
  drawings = []; // the line before and after any of it was played, and the ring
  life = new AbortController();
  /** @param {import("../motion/filmed.js").Filmed} lab */
  constructor(lab) {
    const { model, scene, answer, time: { span } } = lab, { texts } = model;
    this.model = model;
    this.texts = texts;
    this.scene = { ...scene, waits: false };
    this.isMapped = answer.name === "trace";
    const nothing = () => {}, life = this.life.signal, time = (this.time = new Time(nothing, life, CLOCK));
    this.stage = new Stage(texts, time, nothing, { camera: model.camera, life });
    this.strip = new Strip(texts, time);
    this.words = wordsOf(texts, nothing, nothing);
    Object.assign(time, { unit: model.seconds, end: scene.end, span, events: scene.run?.events ?? [], chosen: lab.time.chosen, playing: true, held: true });
    this.pace = part("span");
    this.strip.element.lastChild.append(this.pace);
    this.canvas = part("canvas", { width: WIDE, height: HIGH });
    this.pen = penOf(this.canvas);
    this.frame = part("div", { class: `frame ${CLOCK}` }, part("div", { class: "lab", "data-table": scene.table }, this.stage.element, this.strip.element, this.words.element));
    this.place = part("div", { "aria-hidden": "true", inert: true });
    this.place.attachShadow({ mode: "open" }).append(part("style", {}, STYLE), this.frame);
  }

  // Puts it on the page; it can be drawn when this has ended.
  async begin() {
    const { model, stage, strip, scene, frame } = this;
    document.body.append(this.place);
    followLook(frame, this.life.signal, () => frame.toggleAttribute("data-large", true));
    stage.dress(model, scene.isOpen, this.isMapped);
    for (const top of stage.tops) top.put({ playing: false, now: 0 });
    for (const shown of [stage, strip, this.words]) shown.show(scene);
    while (!strip.width || !filmedOn(CLOCK).length) await new Promise((done) => setTimeout(done)); // for their sizes
    const at = (t) => {
      strip.at(t);
      return imageOf(strip.drawing);
    };
    this.drawings = await Promise.all([at(0), at(this.time.span), imageOf(/** @type {any} */ (stage.ring.firstChild))]);
  }

  // Draws the moment t, in s, at a time of the film in ms.
  /** @param {number} t @param {number} now */
  draw(t, now) {
    const { time, stage, strip, words, pen, frame } = this, origin = frame.getBoundingClientRect();
    for (const top of stage.tops) top.put({ now });
    time.seek(t, true);
    for (const shown of [stage, strip, words]) shown.at(t);
    this.pace.textContent = this.texts.speeds[SPEEDS.indexOf(time.speed)];
    for (const box of [frame, stage.element]) paintBox(pen, box, origin);
    for (const { picture, photo } of filmedOn(CLOCK)) {
      const { x, y, width, height } = picture.getBoundingClientRect();
      pen.drawImage(photo(width), x - origin.x, y - origin.y, width, height);
      for (const scales of picture.querySelectorAll(".scales")) paintWords(pen, scales, origin);
    }
    this.drawStrip(origin);
    this.drawRing(origin);
    for (const box of [stage.pill, stage.chip, stage.missing]) if (box.clientWidth) paintBox(pen, box, origin);
    for (const wording of [stage.pill, stage.chip, stage.missing, stage.ring, ...stage.captions, strip.clock, this.pace, words.element]) paintWords(pen, wording, origin);
  }

  // The line as it is before and after any of it has been played, each on its side of the present time.
  drawStrip(origin) {
    const { strip, pen, drawings: [before, after] } = this, { x, y, width, height } = strip.drawing.getBoundingClientRect();
    const now = strip.line.getBoundingClientRect().x - x, left = x - origin.x, top = y - origin.y;
    for (const [image, from, to] of /** @type {[HTMLImageElement, number, number][]} */ ([[after, -width, now], [before, now, 2 * width]])) {
      pen.save();
      pen.beginPath();
      pen.rect(left + from, top - height, to - from, 3 * height);
      pen.clip();
      pen.drawImage(image, left, top, width, height);
      pen.restore();
    }
    for (const moved of [strip.line, strip.head]) paintBox(pen, moved, origin);
  }

  drawRing(origin) {
    const { stage: { ring }, pen, drawings: [, , image] } = this, { x, y, width, height } = ring.firstChild.getBoundingClientRect();
    if (!width) return;
    pen.save();
    pen.translate(x - origin.x + width / 2, y - origin.y);
    if (ring.classList.contains("back")) pen.scale(-1, 1);
    pen.drawImage(image, -width / 2, 0, width, height);
    pen.restore();
  }

  leave() {
    this.life.abort();
    this.place.remove();
  }
}
