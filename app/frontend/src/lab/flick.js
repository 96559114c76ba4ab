// What a flick on the top asks for: a push, from which the run goes on as soon as it is computed, or a spin.
import { say } from "../parts.js";

// With three digits; to five of a unit.
const digits = (size) => [size, Math.max(0, 2 - Math.floor(Math.log10(size || 1)))];
const written = (x, unit) => x.toFixed(Math.max(0, 4 - Math.floor(Math.log10(unit))));
/** @param {Record<string, any>} texts @param {number} small in mN s */
const sizeOf = ({ push_units: [mN, N], decimal }, small) => say({ decimal }, small < 1000 ? mN : N, { size: digits(small < 1000 ? small : small / 1000) });

// The pushes of a run.
/** @param {Record<string, any>} texts @param {Record<string, any>} state @returns {Pushed[]} */
export const pushesIn = (texts, { of, R, impulse }) => (of?.pushes[0] ?? "").split("~").filter(Boolean).map((row) => {
  const [t, ...numbers] = row.split("_").map(Number), given = numbers.slice(3);
  return { t, point: numbers.slice(0, 3).map((x) => x / R), impulse: given.map((x) => x / impulse), wording: sizeOf(texts, Math.hypot(...given)) };
});

const FIRST = 0.001; // s: a top that has just been let go can be pushed too

/** @implements {Hand} */
export class Flicking {
  /** @param {import("./lab.js").Lab} lab */
  constructor(lab) {
    this.lab = lab;
    this.goesOn = /** @type {number | null} */ (null); // the time of a push that is being computed, s
  }

  hold = (held) => this.lab.time.seek(this.lab.time.t, held);

  sizeText = (size) => sizeOf(this.lab.model.texts, size * this.lab.state.impulse);

  turnsText = (turns) => say(this.lab.model.texts, this.lab.model.texts.lets_go, { turns: [this.within(turns), 0] });

  // The nearest spin that can be set.
  within(turns) {
    const [, most] = this.lab.state.sliders.spin;
    return Math.round(Math.min(Math.max(turns, -most), most)); // either way round
  }

  // A top is pushed once more; what followed later no longer does.
  push = (point, impulse) => {
    const { lab } = this, { state } = lab, t = Number(Math.max(lab.time.t, FIRST).toFixed(4));
    const before = state.of.pushes[0].split("~").filter((push) => push && Number(push.split("_")[0]) < t);
    const row = [t, ...point.map((x) => written(x * state.R, state.R)), ...impulse.map((x) => written(x * state.impulse, state.impulse))];
    this.goesOn = t;
    lab.ask("pushes", [...before, row.join("_")].join("~"));
  };

  spin = (turns) => {
    if (!this.within(turns)) return;
    this.lab.ask("spin", this.within(turns));
    this.lab.anewSpin();
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
