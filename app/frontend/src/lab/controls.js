// The start as a person sets it: spin, tilt and friction, each with a slider and a field, and "Spin it". The table and
// the top itself are in folds.
import { foldOf } from "./body.js";
import { Control } from "../controls/number.js";
import { Picks } from "../controls/picks.js";
import { launchOf } from "./launch.js";
import { lawOf } from "./law.js";
import { part, say } from "../parts.js";

export const INPUTS = ["spin", "tilt", "mu"];

export class Controls {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {() => void} spin */
  constructor(texts, ask, spin) {
    this.texts = texts;
    this.parts = INPUTS.map((name) => new Control(name, texts.inputs[name], texts, ask));
    const [turns] = this.parts;
    this.law = lawOf(texts, ask);
    this.folds = [foldOf(texts, ask, "rubs", "rubs", this.law.element), foldOf(texts, ask, "body", "dims")];
    this.launch = launchOf(texts, {
      spin, launch: () => ask("spin", turns.value), stop: () => ask("stop", ""),
      strength: (share) => say(texts, texts.strength, { spin: [turns.putShare(share), 0] }),
    });
    this.picks = new Picks(this.parts, texts.hand);
    // on a phone these controls are at the foot of the window
    const dock = part("div", { class: "dock" }, part("div", { class: "titled" }, part("h2", {}, texts.hand), this.picks.element, this.launch.element),
      ...this.parts.map(({ element }) => element));
    this.element = part("section", { class: "controls", "aria-label": texts.hand }, dock, ...this.folds.map(({ element }) => element));
  }

  /** @param {any} scene @param {boolean} ahead */
  show(scene, ahead) {
    const { state, table, before } = scene;
    this.launch.show(scene);
    this.law.show(state);
    for (const fold of this.folds) fold.show(state, ahead);
    this.parts[2].note(state.law);
    for (const [i, control] of this.parts.entries()) {
      // ice has no friction to set, and nothing slips on the rough table; three tables share one slider
      const idle = table === "three" ? i > 0 : control.name === "mu" && (table === "rough" || table === "ice"), isThere = control.name in state.sliders;
      control.element.hidden = idle || !isThere;
      if (isThere) control.show(state, ahead);
    }
    this.picks.show();
    if (table === "rough" || table === "ice") this.parts[0].below.replaceChildren();
    else this.parts[0].showEnds(state.ends);
    const was = before?.state.of.spin[0];
    this.parts[0].showWas(was === state.of?.spin[0] ? undefined : was);
    if (table === "rough" || table === "ice") this.parts[0].ends = undefined;
  }
}
