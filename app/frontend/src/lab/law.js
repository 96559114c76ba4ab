// The law of friction of the ordinary table, and what happens where the top hops: for the level "Research".
import { Choice, part } from "./parts.js";

export class Law {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask */
  constructor(texts, ask) {
    const { more } = texts;
    const choice = (name, label, words) => new Choice({ role: "radio", label, kind: "seg", options: Object.entries(words), choose: (chosen) => ask(name, chosen) });
    this.law = choice("law", texts.law, more.law);
    this.landing = choice("landing", more.lands, more.landing);
    this.stem = part("input", { type: "checkbox", onchange: () => ask("stem", this.stem.checked) });
    this.touches = part("label", { class: "touches" }, this.stem, more.stem);
    this.examples = part("select", { "aria-label": more.example, onchange: () => {
      if (this.examples.value) ask("example", this.examples.value);
      this.examples.value = "";
    } }, part("option", { value: "" }, more.example), ...Object.entries(more.presets).map(([name, word]) => part("option", { value: name }, word)));
    this.element = part("div", { class: "law" }, this.examples, this.law.element,
      part("p", { class: "small" }, more.lands), this.landing.element, this.touches);
  }

  /** @param {any} state */
  show({ friction: [law, landing, stem], touches }) {
    this.law.show(law);
    this.landing.show(landing);
    this.stem.checked = stem;
    this.touches.hidden = !touches;
  }
}
