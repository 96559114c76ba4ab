// A page without a server: the Lab of one toy at the starts whose runs are stored in it, and the lesson. app/page/site.py
// writes it. What a hand asks for between two stored values goes to the nearest, and the control says so.
import { bytesOf, fill, valued } from "./data.js";
import { nearestRow } from "./figures/curves.js";
import { inOneLanguage } from "./first.js";
import { TABLES } from "./motion/curves.js";
import { renderLab } from "./lab/lab.js";
import { written } from "./parts.js";
import { renderLesson } from "./learn/lesson.js";
import { drawIn } from "./letter.js";
import { numbersIn } from "./stand_in.js";
import { renderHead } from "./widgets/head.js";
import { renderLook } from "./widgets/look.js";

const WHY = "arms"; // the step of the lesson to which the Lab leads
const ROOMS = { lab: "LabView", learn: "LessonView" };

/** @param {string} base64 */
const unzipped = (base64) => new Response(new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("gzip")));
const read = async (base64) => valued(await unzipped(base64).text());

// The stored value next to one that was asked for.
/** @param {number[]} values @param {number} wanted */
const nearest = (values, wanted) => values[nearestRow(values, wanted)];

class Site {
  /** @param {any} stored */
  constructor(stored) {
    this.stored = stored;
    this.start = { ...stored.first };
    this.table = stored.table ?? TABLES[0];
    this.room = "lab";
    this.step = "";
    this.look = { dark: null, large: false };
    this.wording = /** @type {any} */ ({});
    this.runs = /** @type {any} */ (null); // of the lesson
    /** @type {ReturnType<typeof drawIn>[]} */
    this.parts = [];
    this.looks = this.head = this.lab = this.lesson = /** @type {any} */ (null); // their models
  }

  /** @param {string} language */
  async open(language) {
    const words = (this.words = await read(this.stored.words[language]));
    if (this.stored.lesson) this.runs ??= await read(this.stored.lesson);
    this.wording = {};
    const lab = { ...words.lab, ...(await this.values(0)) };
    for (const part of this.parts) part.leave();
    this.lesson = null;
    document.documentElement.lang = language;
    document.title = words.head.texts.title;
    this.element("about").textContent = words.about;
    this.parts = [drawIn("Look", { ...this.look, texts: { language } }, renderLook), drawIn("Head", words.head, renderHead), drawIn("LabView", lab, renderLab)];
    [this.looks, this.head, this.lab] = this.parts.map(({ model }) => model);
    this.head.on("request", () => this.ofHead(...this.head.request));
    this.lab.on("request", () => this.ofLab(...this.lab.request));
    this.show(0);
  }

  /** @param {string} id @returns {any} */
  element(id) { return document.getElementById(id); }

  // Shows the room; answered: how many requests of the head were.
  /** @param {number} answered */
  show(answered) {
    const { head, room } = this;
    for (const [name, id] of Object.entries(ROOMS)) this.element(id).hidden = name !== room;
    this.element("about").hidden = room !== "lab";
    if (room === "learn") this.learn();
    head.state = { ...head.state, ...this.look, room, tab: room, answered };
  }

  // The lesson begins to play when it is first seen.
  learn() {
    const { lesson } = this.words, state = { step: this.step || lesson.steps[0].name };
    if (this.lesson) return void (this.lesson.state = state);
    const drawn = drawIn("LessonView", { ...lesson, ...this.runs, state }, renderLesson);
    this.lesson = drawn.model;
    this.lesson.on("request", () => this.ofLesson(...this.lesson.request));
    this.parts.push(drawn);
  }

  ofHead(count, name, value) {
    if (name === "language") return void this.open(value);
    if (name === "room") this.room = value;
    else if (name in this.look) this.looks[name] = this.look[name] = value;
    this.show(count);
  }

  ofLesson(_, name, value) {
    if (name === "step") this.step = value;
    if (name !== "lab") return;
    this.room = "lab";
    this.show(this.head.state.answered);
  }

  async ofLab(count, name, value) {
    this.wording = {};
    if (name === "table") this.table = value;
    else if (name in this.start) this.put(name, value);
    else if (name === "why") {
      Object.assign(this, { room: "learn", step: WHY });
      this.show(this.head.state.answered);
    }
    Object.assign(this.lab, await this.values(count));
  }

  put(name, value) {
    const { words, stored: { grid } } = this, { texts } = words.lab;
    if (typeof value !== "number") {
      this.wording = { messages: { [name]: fill(words.no_number, { value }) }, refused: { [name]: value } };
      return;
    }
    const near = (this.start[name] = nearest(grid[name], value)), say = (number) => written(number, String(number).split(".")[1]?.length ?? 0, texts.decimal);
    const { unit } = texts.inputs[name], after = unit && unit !== "°" ? ` ${unit}` : unit;
    const wording = { value: `${say(value)}${after}`, near: `${say(near)}${after}`, all: grid[name].map(say).join("; ") };
    if (near !== value) this.wording = { remarks: { [name]: fill(words.near, wording) } };
  }

  // What the Lab's model has at the present start.
  /** @param {number} answered */
  async values(answered) {
    const { start, stored, table, words } = this, key = Object.values(start).join(" ");
    const [state, told] = words.told[key][table], numbers = numbersIn(await unzipped(stored.runs[key]).arrayBuffer());
    for (const name of Object.keys(numbers)) if (table !== "three" && !name.endsWith(table)) numbers[name] = new ArrayBuffer(0);
    return { ...numbers, told: JSON.stringify(told), state: JSON.stringify({ ...state, ...this.wording, answered }) };
  }
}

/** @param {string} text JSON of what is stored */
export function site(text) {
  const stored = JSON.parse(text);
  const [only, other] = Object.keys(stored.languages), request = new URLSearchParams(location.search).get("lang");
  return new Site(stored).open(other ? inOneLanguage(stored.languages, request) : only);
}
