// On a phone, number controls stand at the foot of the window, one at a time: a button for each, with its value.
import { part } from "../parts.js";

/** @typedef {import("./number.js").Control} Control */

export class Picks {
  /** @param {Control[]} controls @param {string} label */
  constructor(controls, label) {
    this.controls = controls;
    this.buttons = controls.map(({ name, wording }) => {
      const button = part("button", { type: "button", onclick: () => this.pick(name) }, part("span", {}, wording.name), part("b"));
      if (wording.symbol) button.firstElementChild.innerHTML = wording.symbol;
      return button;
    });
    this.element = part("div", { class: "picks", role: "group", "aria-label": label }, ...this.buttons);
    this.pick(controls[0].name);
  }

  /** @param {string} name */
  pick(name) {
    this.controls.forEach((control, i) => {
      control.element.classList.toggle("picked", control.name === name);
      this.buttons[i].setAttribute("aria-pressed", String(control.name === name));
    });
  }

  // The values as their fields have them; a refused one is picked, a hidden one is not.
  show() {
    for (const [i, { element, wording, number }] of this.controls.entries()) {
      const { unit } = wording;
      this.buttons[i].hidden = element.hidden;
      this.buttons[i].lastElementChild.textContent = `${number.value}${unit && unit !== "°" ? " " : ""}${unit}`;
    }
    const refused = this.controls.find(({ element }) => element.matches(".bad:not([hidden])"));
    const picked = this.controls.find(({ element }) => element.matches(".picked:not([hidden])"));
    const first = this.controls.find(({ element }) => !element.hidden);
    const next = refused ?? picked ?? first;
    if (next && !next.element.classList.contains("picked")) this.pick(next.name);
  }
}
