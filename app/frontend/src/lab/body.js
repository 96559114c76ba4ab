// Controls in folds, like those of the start: the top's lengths and ballast, and the friction of the table.
import { Control } from "../controls/number.js";
import { part } from "./parts.js";

export class Body {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {"body" | "rubs"} word @param {"dims" | "rubs"} of their key in the state @param {any[]} first what stands above them */
  constructor(texts, ask, word, of, ...first) {
    this.texts = texts;
    this.ask = ask;
    this.of = of;
    this.names = "";
    /** @type {Control[]} */
    this.parts = [];
    this.place = part("div");
    this.element = part("details", { class: "body" }, part("summary", {}, texts[word]), ...first, this.place);
  }

  /** @param {any} state @param {boolean} ahead */
  show(state, ahead) {
    const { texts } = this, wanted = state[this.of] ?? [], names = JSON.stringify(wanted);
    this.element.hidden = !wanted.length;
    if (names !== this.names) {
      this.names = names;
      this.parts = wanted.map(([name, word, unit]) => new Control(name, { name: word, typed: word, unit }, texts, this.ask));
      this.place.replaceChildren(...this.parts.map(({ element }) => element));
    }
    for (const control of this.parts) {
      control.show(state, ahead);
      control.note(state.notes[control.name] ?? "");
      if (state.messages[control.name]) this.element.open = true;
    }
  }
}
