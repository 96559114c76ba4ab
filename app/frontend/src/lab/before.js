// "What did I change?": the previous run is shown beside the present one until it is dismissed; not with three tables.
import { say, written } from "../parts.js";

const SIZE = "dim:"; // a dimension of the body
const GESTURE = 1500; // ms: changes of the same input that follow each other faster count as one
const TELLING = ["stands-on-stem", "stands-inverted", "stands-upright", "over", "falls", "leans", "rolls", "lies"]; // the first of these tells how a run went

export class Before {
  /** @param {Record<string, any>} texts */
  constructor(texts) {
    this.texts = texts;
    this.run = this.last = /** @type {any} */ (null);
    this.isBack = false; // whether the next run is the one that the person went back to
    this.isAnswered = true; // whether the next run was requested elsewhere: by undo, or in another room
    this.name = "";
    this.touched = -Infinity;
    this.press = 0;
  }

  // Called when a person changes an input while `shown` is on the page. One press is one change, however long it lasts.
  /** @param {string} name @param {any} shown @param {number} press its number, from 1; 0 if nothing is pressed @param {number} now in ms */
  touch(name, shown, press = 0, now = performance.now()) {
    const isSame = name === this.name && (press ? press === this.press : now - this.touched <= GESTURE);
    if (!isSame) this.last = shown;
    this.name = name;
    this.touched = now;
    this.press = press;
    this.isBack = this.isAnswered = false;
  }

  forget() {
    this.run = this.last = null;
    this.name = "";
  }

  // The run to show beside the next scene, or null.
  /** @param {any} shown the scene until now @param {any} next @param {boolean} answered whether nothing else is requested */
  follow(shown, next, answered) {
    if (!shown || shown.table === "three" || next.table === "three" || !next.state.of) {
      this.forget();
      return null;
    }
    if (changes(shown, next).length) this.run = this.isBack ? null : this.earlier(shown, next);
    this.isAnswered ||= answered;
    const what = this.run ? changes(this.run, next) : [];
    if (this.run && !what.length) this.run = null; // all inputs are the same again
    return this.run && { ...this.run, ...this.words(what, this.run, next) };
  }

  // What a person changed here is compared with the run before all of the gesture; what was changed elsewhere, with the
  // run that was shown here, unless that leads back to the earlier one.
  earlier(shown, next) {
    const { run } = this;
    if (this.isAnswered) return run && !changes(run, next).length ? null : { ...shown, before: null };
    return { ...(this.last ?? shown), before: null };
  }

  // Dismisses the earlier run and requests it again, with ask().
  /** @param {(name: string, value: any) => void} ask @param {any} shown */
  goBack(ask, shown) {
    const { run } = this;
    this.forget();
    for (const name of run ? changes(run, shown) : []) ask(name, run.state.of[name][0]);
    this.isBack = true;
  }

  words(what, run, next) {
    const { texts } = this, wording = (name) => texts.inputs[name]?.name ?? next.state.of[name][2] ?? texts.toy;
    const value = (scene, name) => scene.state.of[name][1].replace(`${wording(name)} `, "");
    const changed = what.map((name) => say(texts, texts.changed, { name: wording(name), from: value(run, name), to: value(next, name) })).join("; ");
    const isTable = what.includes("table"); // then the stage says enough
    return {
      canGoBack: !what.includes("toy") || run.state.toy === run.state.of.toy?.[0], // a body without a name cannot be requested
      what: what.map((name) => run.state.of[name][1]).join(", "), compared: isTable ? "" : say(texts, texts.compared, { changed, before: this.end(run) }),
    };
  }

  // How a run went, in a few words.
  end({ run, state: { runs }, table }) {
    const { events, stages, why } = run ?? runs[table] ?? { events: [], stages: [], why: "" };
    const code = TELLING.find((each) => events.some(([, name]) => name === each));
    if (!code) return why || (stages[0]?.[3] ?? "");
    const [t, , word] = events.find(([, name]) => name === code), { texts } = this;
    return `${word} (${written(t, 1, texts.decimal)} s)`;
  }
}

// The inputs that differ between two scenes; of numbers, by more than rounding.
const differ = (one, other) => one?.[0] !== other[0] && !(Math.abs(one?.[0] - other[0]) <= 1e-9 * Math.abs(other[0]));
function changes(one, other) {
  const [a, b] = [one.state.of, other.state.of];
  if (!a || !b) return [];
  const found = Object.keys(b).filter((name) => differ(a[name], b[name])), sizes = found.filter((name) => name.startsWith(SIZE));
  // a body of another kind has other dimensions
  const isOther = sizes.some((name) => !a[name]) || Object.keys(a).some((name) => !b[name]) || sizes.length > 1;
  return found.filter((name) => a[name] && (isOther ? !name.startsWith(SIZE) : name !== "toy" || !sizes.length));
}

/** @param {any} before @param {number} t @param {number} column */
export const thenAt = (before, t, column) => before.curves[before.table].at(t, column);

