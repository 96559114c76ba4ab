// A part of a range: two native sliders over one track, and its two ends as numbers.
import { fill } from "../data.js";
import { follow } from "../life.js";
import { entry } from "./entry.js";
import { frame } from "./frame.js";
import { forFingers, numbers } from "./style.js";
import { explain } from "./wrong.js";
import { part, read, written } from "../parts.js";

const style = `${numbers} .ctl { width: 100%; } .track { grid-column: 1 / -1; position: relative; height: 24px; }
.track::before { content: ""; position: absolute; inset: 10px 0; border-radius: 2px;
  background: linear-gradient(90deg, var(--line-2) var(--p), var(--accent) var(--p) var(--q), var(--line-2) var(--q)); }
.ctl .track input[type=range] { position: absolute; inset: 0; height: 100%; margin: 0; pointer-events: none; }
.track input::-webkit-slider-runnable-track { background: none; } .track input::-moz-range-track { background: none; }
.track input::-webkit-slider-thumb { pointer-events: auto; } .track input::-moz-range-thumb { pointer-events: auto; } .num { width: 10ch; }
@media (max-width: 700px) { ${forFingers} .track { height: 44px; } .track::before { inset: 20px 0; } }`;

class Ends {
  /** @param {Rendering<StretchModel>} rendering */
  constructor(rendering) {
    this.model = rendering.model;
    this.pulled = [0, 1];
    this.wrong = part("p", { class: "wrong", role: "alert", hidden: true });
    const { texts } = this.model;
    this.sliders = [0, 1].map((i) => part("input", { type: "range", step: "any", "aria-label": `${this.model.label}, ${texts.ends[i]}`,
      oninput: () => this.pull(i), onchange: () => this.send(this.pulled), onkeydown: (event) => this.step(i, event) }));
    this.entries = [0, 1].map((i) => entry({ "aria-label": `${this.model.label}, ${texts.ends[i]}` }, () => this.typed(i), () => this.show()));
    this.track = part("div", { class: "track" }, ...this.sliders);
    frame(rendering, style, part("div", { class: "ctl" }, part("b", {}, this.model.label),
      part("span", {}, this.entries[0], " – ", this.entries[1], part("span", { class: "unit" }, this.model.unit)), this.track, this.wrong));
    follow(this.model, ["value", "start", "end", "digits"], () => this.show());
  }

  show(value = this.model.value) {
    const { start, end, digits, texts } = this.model;
    this.pulled = [...value];
    for (const [i, name] of ["--p", "--q"].entries()) {
      Object.assign(this.sliders[i], { min: start, max: end });
      this.sliders[i].value = String(value[i]);
      this.entries[i].value = written(value[i], digits, texts.decimal);
      this.sliders[i].setAttribute("aria-valuetext", `${this.entries[i].value} ${this.model.unit}`);
      this.track.style.setProperty(name, `${(100 * (value[i] - start)) / (end - start || 1)}%`);
    }
    explain(this.wrong, "", []);
  }

  // A thumb stops at the other one.
  pull(i) {
    const { start, step, end } = this.model, at = start + Math.round((Number(this.sliders[i].value) - start) / step) * step;
    const [low, high] = i ? [this.pulled[0], end] : [start, this.pulled[1]];
    this.show(this.pulled.map((was, k) => (k === i ? Math.min(Math.max(at, low), high) : was)));
  }

  // By keys one step of its own, because "any" has none.
  step(i, event) {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
    if (!by) return;
    event.preventDefault();
    this.sliders[i].value = String(this.pulled[i] + by * this.model.step);
    this.pull(i);
    this.send(this.pulled);
  }

  send(value) {
    if (value.every((each, i) => each === this.model.value[i])) return this.show();
    this.show(value);
    this.model.pulled = [this.model.pulled[0] + 1, value[0], value[1]];
  }

  typed(i) {
    const { start, end, digits, texts, unit } = this.model, text = this.entries[i].value, value = read(text);
    const [low, high] = i ? [this.pulled[0], end] : [start, this.pulled[1]], says = (number) => `${written(number, digits, texts.decimal)} ${unit}`;
    if (value >= low && value <= high) return this.send(this.pulled.map((was, k) => (k === i ? value : was)));
    const near = value > high ? high : low, why = fill(texts.wrong, { text, low: says(low), high: says(high) });
    explain(this.wrong, why, [[fill(texts.take, { value: says(near) }), () => this.send(this.pulled.map((was, k) => (k === i ? near : was)))],
      [fill(texts.back, { value: says(this.pulled[i]) }), () => this.show()]]);
  }
}

/** @param {Rendering<StretchModel>} rendering */
export const renderStretch = (rendering) => void new Ends(rendering);
