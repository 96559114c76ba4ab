// The tilt over time, which also controls the time: play, drag anywhere on it, the speed, and back to the start.
import { latest, placed, TABLES, ticks, TILT } from "../motion/curves.js";
import { FOOT, LEFT, levels, marks, RIGHT, TimeLine, times } from "../figures/line.js";
import { drawn, fontSize, icon, part, say } from "../parts.js";
import { SPEEDS } from "./time.js";

const GAP = 6; // px between the plot and what is left of it
const LETTER = 0.51; // mean width of a letter, in units of the font size
const NARROW = 660; // px: a narrower strip uses short words
const NEED = 100; // px: a shorter stage of the run has no room for a small top
export class Strip extends TimeLine {
  /** @param {Record<string, any>} texts @param {import("./time.js").Time} time */
  constructor(texts, time) {
    super(texts, time, { label: texts.time, step: 0.01 });
    /** @type {import("../motion/curves.js").Curves | null} */
    this.before = null;
    this.size = 0; // px, of the font; not known yet
    this.isNarrow = false; // nor this
    this.clock = part("span", { class: "clock" });
    this.speed = part("select", {
      class: "speed", "aria-label": texts.speed, onchange: () => time.chose(Number(this.speed.value)),
    }, part("option", { value: 0 }), ...SPEEDS.map((speed, i) => part("option", { value: speed }, texts.speeds[i])));
    const again = part("button", { class: "again", type: "button", title: texts.again_hint, onclick: () => {
      time.again();
      time.play(true);
    } }, icon("again"), ` ${texts.again}`);
    this.element = part("section", { class: "strip timeline", "aria-label": texts.bar },
      part("div", { class: "starts" }, this.play, this.clock), this.plot, part("div", { class: "paces" }, this.speed, again));
  }

  get right() {
    return this.width - RIGHT - (this.scene.table === "three" && this.width > 700 ? 15 * this.size : 0);
  }

  y = (tilt) => this.bottom - ((this.bottom - this.top) * tilt) / 180;

  show(scene) {
    const { before } = scene, curves = before?.curves[before.table];
    this.scene = scene;
    this.before = curves?.count ? curves : null; // of the earlier run
    this.range.max = (Math.ceil(100 * scene.end) / 100).toFixed(2); // a whole number of its steps
    this.draw();
  }

  // Short where there is little room. The list is as wide as its longest words, because a plot that became narrower
  // while the speed changes would leave the hand on it.
  writeSpeeds() {
    const { texts, speed, isNarrow } = this, names = isNarrow ? texts.short_speeds : texts.speeds;
    SPEEDS.forEach((_, i) => (speed.options[i + 1].text = names[i]));
    const longest = Math.max(...names.map((name) => say(texts, texts.automatic, { speed: name }).length));
    speed.style.minWidth = isNarrow ? "" : `calc(${longest}ch + 2em)`;
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.plot, { scene } = this;
    if (!width || !scene) return;
    const size = fontSize(this.plot);
    this.isNarrow = this.element.clientWidth < NARROW; // by the whole: the plot is wider beside short words, and would not be narrow then
    Object.assign(this, { width, size, top: 19 + 1.2 * size, bottom: height - FOOT });
    this.writeSpeeds();
    const shown = scene.table === "three" ? TABLES : [scene.table];
    const lines = shown.filter((table) => scene.curves[table].count).map((table) => {
      const points = scene.curves[table].points(this.x, this.y, TILT);
      return (of) => drawn("polyline", { class: `${of} ${table}`, points });
    });
    this.clip = drawn("rect", { x: 0, y: 0, width: 0, height });
    this.drawing.replaceChildren(
      drawn("clipPath", { id: "played" }, this.clip), drawn("clipPath", { id: "all" }, drawn("rect", { x: 0, y: 0, width: this.right + 1, height })), ...this.axes(), ...this.events(), ...this.shapes(),
      ...this.then(), ...lines.map((line) => line("rest")), drawn("g", { "clip-path": "url(#played)" }, ...lines.map((line) => line("past"))),
      ...this.names(), ...this.comes(), ...this.nameThen(),
    );
    this.drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.at(this.time.t);
  }

  // The earlier run.
  then() {
    const { before: curves } = this;
    return curves ? [drawn("polyline", { class: "then", "clip-path": "url(#all)", points: curves.points(this.x, this.y, TILT) })] : [];
  }

  nameThen() {
    const { before: curves, texts } = this;
    if (!curves) return [];
    const t = 0.62 * Math.min(curves.end, this.time.end), y = this.y(curves.at(t, TILT));
    return [drawn("text", { class: "halo", x: this.x(t), y: y > (this.top + this.bottom) / 2 ? y - 7 : y + 16 }, texts.then)];
  }

  axes() {
    const { time: { span }, texts } = this;
    return [...levels([0, 90, 180], { y: this.y, left: LEFT, right: this.right }, (tilt) => `${tilt}°`),
      ...marks(ticks(0, span || 1, Math.min(8, this.width / 50)), this, times(texts))];
  }

  // What happened and when, above the curve.
  events() {
    const { scene, texts } = this;
    const { size } = this, isPush = ([, code]) => code === "push", first = (event) => (isPush(event) ? 2 : Number(/^(over|stands.*|falls)$/.test(event[1]))); // which find their places first
    const three = scene.table === "three", all = (three ? TABLES : [scene.table]).flatMap((name) => scene.runs[name]?.events ?? []);
    /** @type {any} */
    const events = three ? [] : [...all].sort((one, other) => first(other) - first(one));
    const when = (t) => say(texts, "{t} s", { t: [t, 1] });
    const lines = events.map(([t, , word, short]) => [this.x(t), `${word} ${when(t)}`, `${short} ${when(t)}`]);
    const words = placed(lines, -GAP, this.width, (word) => LETTER * size * word.length);
    const alone = [...new Set(all.filter(isPush).map(([t]) => this.x(t)))].filter((each) => words.every(({ x }) => x !== each)); // without room
    return alone.map((x) => drawn("line", { class: "event", x1: x, x2: x, y1: this.top, y2: this.bottom })).concat(words.flatMap(({ x, word, side, row }) => {
      const cut = word.lastIndexOf(" ", word.length - 3), down = 1.2 * size * row;
      return [
        drawn("line", { class: "event", x1: x, x2: x, y1: 4 + down, y2: this.bottom }),
        drawn("text", { x: side === "start" ? x + 5 : x - 5, y: 14 + down, "text-anchor": side },
          drawn("tspan", { class: "word" }, word.slice(0, cut)), word.slice(cut)),
      ];
    }));
  }

  // A small top, tilted as in the middle of each long stage, where the curve leaves room.
  shapes() {
    const { scene } = this, run = scene.runs[scene.table], n = scene.profile.length >> 1, curves = scene.curves[scene.table];
    if (!run || !n || !curves.count || this.before || this.width < 500) return []; // the earlier run needs the room
    const outline = Array.from({ length: 2 * n }, (_, i) => {
      const at = i < n ? i : 2 * n - 1 - i;
      return [(i < n ? 1 : -1) * scene.profile[2 * at], -scene.profile[2 * at + 1]];
    });
    const from = [0, ...run.events.map(([t]) => t)], reach = Math.max(...scene.profile.map(Math.abs));
    const R = Math.min(12, 24 / reach); // px; a body with a long stem is drawn smaller
    return from.flatMap((start, i) => {
      const until = from[i + 1] ?? scene.end;
      if (this.x(until) - this.x(start) < NEED) return [];
      const t = start + 0.42 * (until - start), tilt = curves.at(t, TILT), angle = (Math.PI * tilt) / 180;
      const c = Math.cos(angle), s = Math.sin(angle);
      const turned = outline.map(([x, y]) => [x * c - y * s, x * s + y * c]), least = Math.max(...turned.map(([, y]) => y));
      const table = tilt > 90 ? this.y(26) : this.y(95), x = this.x(t);
      return [drawn("path", { class: "shape", d: `M${turned.map(([px, py]) => `${(x + R * px).toFixed(1)} ${(table + R * (py - least)).toFixed(1)}`).join("L")}Z` }),
        drawn("line", { class: "shape", x1: x - 15, x2: x + 15, y1: table + 1, y2: table + 1 })];
    });
  }

  // Marks where the rest of the run will be.
  comes() {
    const { scene, size, texts: { comes }, time } = this, from = this.x(time.end), room = this.right - from;
    if (scene.state.whole || room < NEED) return [];
    const cut = LETTER * size * comes.length > room ? comes.indexOf(" ", comes.length / 2) : -1; // into two lines
    const lines = cut < 0 ? [comes] : [comes.slice(0, cut), comes.slice(cut + 1)], x = (from + this.right) / 2;
    return lines.map((line, i) => drawn("text", { class: "halo", x, y: this.y(90) - 5 - 1.2 * size * (lines.length - 1 - i), "text-anchor": "middle" }, line));
  }

  // The names of three curves, at their ends, where there is room.
  names() {
    const { scene, texts } = this;
    if (scene.table !== "three" || this.width <= 700) return [];
    const ends = TABLES.filter((table) => scene.curves[table].count)
      .map((table) => ({ table, y: this.y(scene.curves[table].at(scene.end, TILT)) + 4 })).sort((a, b) => b.y - a.y);
    ends.forEach((end, i) => (end.y = i ? Math.min(end.y, ends[i - 1].y - 1.25 * this.size) : end.y));
    return ends.map(({ table, y }) => drawn("text", { x: this.right + 8, y },
      drawn("tspan", { class: "word" }, texts.tables[table]), ` ${scene.runs[table].caption || (scene.runs[table].stages.at(-1)?.[3] ?? "")}`));
  }

  /** @param {number} t */
  at(t) {
    const { time, texts, scene } = this;
    if (!this.width) return;
    this.clip.setAttribute("width", String(Math.max(this.move(t), 0)));
    this.clock.textContent = say(texts, "{t} s", { t: [t, 2] });
    const curves = scene.curves[scene.table === "three" ? "ordinary" : scene.table];
    const [, headline] = latest(scene.run?.stages ?? [], t) ?? [];
    this.range.setAttribute("aria-valuetext", say(texts, texts.time_says, { t: [t, 2], tilt: [curves.at(t, TILT) || 0, 0], headline: headline ?? "" }));
    const speed = String(time.chosen);
    if (this.speed.value !== speed) this.speed.value = speed;
    const { isNarrow } = this, fits = (isNarrow ? texts.short_speeds : texts.speeds)[SPEEDS.indexOf(time.speed)];
    const own = isNarrow ? fits : say(texts, texts.automatic, { speed: fits });
    if (this.speed.options[0].text !== own) this.speed.options[0].text = own;
  }
}
