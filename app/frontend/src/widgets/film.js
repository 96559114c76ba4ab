// The film of the Lab in Share: a button for each kind of file that this browser can write, the stretch that is filmed,
// and while it is made, how far that is, and a button that stops it.
import { renderStretch } from "../controls/stretch.js";
import { frame, whenSeen } from "../controls/frame.js";
import { atEnd } from "../life.js";
import { offer, progress } from "../controls/style.js";
import { part, say } from "../parts.js";
import { HIGH, labInSight, timesOf, WIDE } from "../motion/filmed.js";
import { modelOf } from "../stand_in.js";
import { save } from "./saving.js";

const MOST_S = 30, TELL_MS = 50, HD = { width: WIDE, height: HIGH, rate: 30 };
const SIZES = { webm: HD, mp4: HD, gif: { width: WIDE / 2, height: HIGH / 2, rate: 20 } }; // a GIF counts in 1/100 s
// Of a kind, the codecs of which the browser must be able to write one, and what the library calls them.
const CODECS = { webm: { "vp09.00.31.08": "vp9", vp8: "vp8" }, mp4: { "avc1.640028": "avc", "avc1.42001f": "avc" } };
const STYLE = `${offer}.wait { display: flex; gap: 8px; align-items: center; } ${progress}`;

// A codec of this kind that the browser can write; undefined if there is none, as on every page without TLS.
/** @param {keyof typeof CODECS} kind */
async function codecOf(kind) {
  if (typeof VideoEncoder === "undefined") return undefined;
  for (const [codec, name] of Object.entries(CODECS[kind])) {
    const { width, height, rate } = HD, wish = { codec, width, height, framerate: rate, bitrate: 4e6 };
    if ((await VideoEncoder.isConfigSupported(wish).catch(() => null))?.supported) return name;
  }
  return undefined;
}

// Lets the page go on. A timer would take a second while the page is out of sight.
const breathe = () => new Promise((done) => {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => done(port1.close());
  port2.postMessage(0);
});

class Films {
  /** @param {Rendering<FilmModel>} rendering */
  constructor(rendering) {
    const { model: { texts } } = rendering;
    this.rendering = rendering;
    this.texts = texts;
    this.making = this.stopped = false;
    this.end = 0; // s: of the run that is in sight
    /** @type {any} */
    this.ends = null; // the model of the control of the stretch
    this.buttons = Object.keys(SIZES).map((kind) => part("button", { type: "button", class: "outline word", hidden: kind !== "gif", onclick: () => this.make(kind) },
      { webm: "WebM", mp4: "MP4", gif: "GIF" }[kind]));
    this.progress = part("progress", { max: 1, "aria-label": texts.progress });
    this.wait = part("span", { class: "wait", hidden: true }, this.progress, part("button", { type: "button", class: "outline word", onclick: () => (this.stopped = true) }, texts.stop));
    this.files = part("span", { class: "wait" }, ...this.buttons);
    this.wording = part("p", { class: "small", role: "status" });
    this.stretch = part("div");
    this.inner = /** @type {Rendering<FilmModel>["view"]} */ ({});
    this.life = frame(rendering, STYLE, part("div", { class: "all" }, part("span", { class: "says" }, part("b", {}, texts.title), part("span", { class: "small" }, texts.says)),
      this.files, this.wait, this.stretch, this.wording));
    this.offer();
  }

  async offer() {
    /** @type {Record<string, string | undefined>} */
    this.codecs = { webm: await codecOf("webm"), mp4: await codecOf("mp4") };
    Object.keys(SIZES).forEach((kind, i) => (this.buttons[i].hidden = kind !== "gif" && !this.codecs[kind]));
  }

  // Fits the stretch to the run that is in sight.
  look() {
    const lab = labInSight();
    this.stretch.hidden = this.files.hidden = !lab;
    if (!lab) return void (this.wording.textContent = this.texts.elsewhere);
    const { scene: { end } } = lab, value = this.ends?.value;
    if (this.end !== end) {
      const kept = value && value[1] <= end && value[1] < this.end;
      this.end = end;
      this.bound(kept ? value : [0, end]);
    }
    this.tell(lab);
  }

  // The two ends are the control of other rooms; here nobody but this hears of it.
  bound(value) {
    const ends = (this.ends = modelOf({ texts: this.texts, label: this.texts.stretch, start: 0, end: this.end, step: 0.01, digits: 2, unit: "s", value, pulled: [0, 0, 0] }));
    ends.on("pulled", () => {
      ends.value = ends.pulled.slice(1);
      this.look();
    });
    renderStretch({ model: this.ends, el: this.stretch, view: this.inner });
  }

  times(lab, { rate }) {
    const { time } = lab, paced = Object.assign(Object.create(time), { t: 0 });
    return timesOf(this.ends.value, (t) => Object.assign(paced, { t }).speed, rate, MOST_S * rate);
  }

  // How long the film would be, and what cannot be.
  tell(lab) {
    const { texts } = this, times = this.times(lab, HD), until = times.at(-1), whole = until === this.ends.value[1];
    const length = say(texts, whole ? texts.length : texts.cut, { length: [times.length / HD.rate, 1], most: MOST_S, until: [until, 2] });
    this.wording.textContent = [length, this.codecs && !this.codecs.webm && !this.codecs.mp4 ? texts.no_encoder : ""].join(" ");
  }

  async make(kind) {
    const lab = labInSight(), { rendering: { model }, texts, progress: bar } = this;
    if (this.making || !lab) return;
    this.making = true;
    this.stopped = false;
    bar.value = 0;
    [this.files.hidden, this.wait.hidden, this.wording.textContent] = [true, false, ""];
    const film = lab.film(), size = SIZES[kind], times = this.times(lab, size);
    let wording = texts.made;
    try {
      const [{ writerOf }] = await Promise.all([import(new URL(model.encoders, document.baseURI).href), film.begin()]);
      const writer = await writerOf(kind, this.codecs?.[kind], film.canvas, size);
      const done = await this.write(film, writer, times, size);
      if (done) save(done, `tippe-top-${lab.scene.table}.${kind}`);
      else wording = texts.stopped;
    } catch (error) {
      console.warn(error);
      wording = say(texts, texts.failed, { why: String(error instanceof Error ? error.message : error) });
    }
    film.leave();
    this.making = false;
    [this.files.hidden, this.wait.hidden, this.wording.textContent] = [false, true, wording];
  }

  async write(film, writer, times, { rate }) {
    let before = performance.now();
    for (const [i, t] of times.entries()) {
      film.draw(t, (1000 * i) / rate);
      await writer.add(i);
      this.progress.value = (i + 1) / times.length;
      if (performance.now() - before > TELL_MS) {
        await breathe();
        before = performance.now();
      }
      if (this.stopped) return void (await writer.stop());
    }
    return writer.end();
  }
}

/** @param {Rendering<FilmModel>} rendering */
export function renderFilm(rendering) {
  const films = new Films(rendering), look = () => !films.making && films.look();
  whenSeen(films.wording.parentElement, look, films.life);
  atEnd(films.life, () => {
    films.stopped = true;
    films.inner.tippe?.dispose();
  });
  rendering.model.on("anew", look);
}
