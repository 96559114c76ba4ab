// What a flick on the top asks for: a push, from which the run goes on as soon as it is computed, or a spin.
import { say } from "./parts.js";

// With three digits.
const digits = (size) => [size, Math.max(0, 2 - Math.floor(Math.log10(size || 1)))];
const FIRST = 0.001; // s: a top that has just been let go can be pushed too

/** @implements {Hand} */
export class Flicking {
  /** @param {import("./lab.js").Lab} lab */
  constructor(lab) {
    this.lab = lab;
    this.goesOn = /** @type {number | null} */ (null); // the time of a push that is being computed, s
  }

  hold = (held) => this.lab.time.seek(this.lab.time.t, held);

  saidSize = (size) => {
    const { model: { texts }, state } = this.lab, small = size * state.impulse, [mN, N] = texts.push_units;
    return small < 1000 ? say(texts, mN, { size: digits(small) }) : say(texts, N, { size: digits(small / 1000) });
  };

  saidTurns = (turns) => say(this.lab.model.texts, this.lab.model.texts.lets_go, { turns: [this.within(turns), 0] });

  // The nearest spin that can be set.
  within(turns) {
    const [, most] = this.lab.state.sliders.spin;
    return Math.round(Math.min(Math.max(turns, -most), most)); // either way round
  }

  // A top is pushed once more; what followed later no longer does.
  push = (point, impulse) => {
    const { lab } = this, { state } = lab, t = Math.max(lab.time.t, FIRST);
    const before = state.of.pushes[0].split("~").filter((push) => push && Number(push.split("_")[0]) < t);
    const row = [t.toFixed(4), ...point.map((x) => (x * state.R).toFixed(3)), ...impulse.map((x) => (x * state.impulse).toFixed(4))];
    this.goesOn = t;
    lab.ask("pushes", [...before, row.join("_")].join("~"));
  };

  spin = (turns) => {
    if (!this.within(turns)) return;
    this.lab.ask("spin", this.within(turns));
    this.lab.spin();
  };

  // Goes on once the answer is there, also if it is that this cannot be.
  answered() {
    const { goesOn, lab } = this;
    if (goesOn === null || lab.asking.isAhead || lab.state.busy) return;
    this.goesOn = null;
    lab.time.seek(goesOn);
    lab.time.play(true);
  }
}
