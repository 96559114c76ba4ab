// What every time line has: a button that plays, a plot on which a press sets the time, and a mark of the present time.
import { drawn, icon, part, say } from "../parts.js";

export const LEFT = 38, RIGHT = 12, FOOT = 22; // px around the plot

// Lines across with their numbers at the left; the axis is the line of one of the values.
/** @param {number[]} values @param {{ y: (value: number) => number, left: number, right: number }} plot @param {(value: number) => string} word @param {number} down px from a line to the base line of its number */
export const levels = (values, { y, left, right }, word, axis = 0, down = 4) => values.flatMap((value) => [
  drawn("line", { class: Math.abs(value - axis) < 1e-9 ? "axis" : "grid", x1: left, x2: right, y1: y(value), y2: y(value) }),
  drawn("text", { x: left - 6, y: y(value) + down, "text-anchor": "end" }, word(value)),
]);

// Numbers along the foot.
/** @param {number[]} values @param {{ x: (value: number) => number, bottom: number }} plot @param {(value: number) => string} word @param {number} down px from the foot to their base line */
export const marks = (values, { x, bottom }, word, down = 16) =>
  values.map((value) => drawn("text", { x: x(value), y: bottom + down, "text-anchor": "middle" }, word(value)));

// The same for times, of which 0 has the unit.
/** @param {Record<string, any>} texts @param {number} [digits] without it one, where it is needed */
export const times = (texts, digits) => (/** @type {number} */ t) =>
  say(texts, t ? "{t}" : "{t} s", { t: [t, t ? (digits ?? (t % 1 ? 1 : 0)) : 0] });

export class TimeLine {
  /** @param {Record<string, any>} texts @param {import("../lab/time.js").Time} time @param {{ label: string, step: number | "any" }} range */
  constructor(texts, time, { label, step }) {
    this.texts = texts;
    this.time = time;
    /** @type {any} */
    this.scene = undefined;
    this.width = this.top = this.bottom = 0; // px; not known yet
    this.play = part("button", { class: "round", type: "button", onclick: () => time.play(!time.playing) });
    this.range = part("input", {
      type: "range", class: "at", min: 0, step, "aria-label": label,
      oninput: () => time.seek(Number(this.range.value)),
      onkeydown: (event) => {
        if (event.key !== " ") return;
        event.preventDefault();
        time.play(!time.playing);
      },
    });
    this.drawing = drawn("svg", { "aria-hidden": "true" });
    this.head = part("span", { class: "head" });
    this.line = part("span", { class: "now" });
    this.plot = part("div", { class: "plot" }, this.drawing, this.range, this.line, this.head);
    this.listen();
    new ResizeObserver(() => this.draw()).observe(this.plot);
  }

  // The pointer takes over the time as soon as it is pressed, even if it does not move at first.
  listen() {
    const { plot, time } = this;
    const put = (event, held) => time.seek(this.timeAt(event.clientX - plot.getBoundingClientRect().left), held);
    plot.addEventListener("pointerdown", (event) => {
      if (event.button || !this.scene) return;
      event.preventDefault();
      plot.setPointerCapture(event.pointerId);
      this.range.focus({ preventScroll: true });
      put(event, true);
    });
    plot.addEventListener("pointermove", (event) => plot.hasPointerCapture(event.pointerId) && put(event, true));
    for (const end of ["pointerup", "pointercancel"]) plot.addEventListener(end, () => time.held && time.seek(time.t));
  }

  draw() {}

  get right() { return this.width - RIGHT; }

  // The length of the axis, in s.
  get whole() { return this.time.span || 1; }

  x = (t) => LEFT + ((this.right - LEFT) * t) / this.whole;
  timeAt = (x) => ((x - LEFT) / (this.right - LEFT)) * this.whole;

  // Shows the time, and whether it goes on.
  /** @param {number} t */
  move(t) {
    const name = this.time.playing ? "pause" : "play", x = this.x(t);
    for (const moved of [this.head, this.line]) moved.style.transform = `translateX(${x}px)`;
    if (this.icon !== name) {
      this.icon = name;
      this.play.replaceChildren(icon(name));
      this.play.setAttribute("aria-label", this.texts[name]);
    }
    this.range.value = String(t);
    return x;
  }
}
