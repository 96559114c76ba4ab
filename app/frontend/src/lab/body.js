// The top itself, in a fold: its lengths and its ballast, as controls like those of the start.
import { Control } from "./control.js";
import { part } from "./parts.js";

export class Body {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask */
  constructor(texts, ask) {
    this.texts = texts;
    this.ask = ask;
    this.names = "";
    /** @type {Control[]} */
    this.parts = [];
    this.place = part("div");
    this.element = part("details", { class: "body" }, part("summary", {}, texts.body), this.place);
  }

  /** @param {any} state @param {boolean} ahead */
  show(state, ahead) {
    const { texts } = this, names = JSON.stringify(state.dims);
    this.element.hidden = !state.dims?.length;
    if (names !== this.names) {
      this.names = names;
      this.parts = (state.dims ?? []).map(([name, word, unit]) => new Control(name, { name: word, typed: word, unit }, texts, this.ask));
      this.place.replaceChildren(...this.parts.map(({ element }) => element));
    }
    for (const control of this.parts) {
      control.show(state, ahead);
      if (state.messages[control.name]) this.element.open = true;
    }
  }
}
