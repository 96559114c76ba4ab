// A group of number controls and choices, in the order in which Python lists them. One request at a time is on its way.
import { atEnd, followLook, lifeOf } from "../life.js";
import { Control } from "./number.js";
import { Picks } from "./picks.js";
import { dock, forFingers, numbers, segments, shared } from "./style.js";
import { ask } from "../data.js";
import { Asking } from "./asking.js";
import { Choice, part } from "../parts.js";

const style = `${shared}${numbers}${segments}
.group { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 220px), 1fr)); gap: 8px 24px; align-items: start; }
.group :is(.titled, .choice), .group > .small { grid-column: 1 / -1; } .group > .dock { display: contents; }
.group .choice { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 8px; }
.ctl .unit { min-width: 0; } .ctl .unit:empty { display: none; } .ctl label[title], [title] { cursor: help; } .ctl .small { min-height: calc(1.45em * var(--lines, 0)); }
i, sub, sup { font-family: Georgia, serif; } sub, sup { font-size: .75em; line-height: 0; }
.bad input[type=range] { opacity: .38; } .bad .small { display: none; }
.ticks { position: relative; height: 1.6em; margin-top: -4px; font-size: var(--t-s); color: var(--ink-2); }
.ticks span { position: absolute; transform: translateX(-50%); padding-top: 4px; white-space: nowrap; }
.ticks span:first-child { transform: translateX(-10px); }
.ticks span::before { content: ""; position: absolute; left: 50%; top: 0; height: 5px; border-left: 1px solid; } .ticks span:first-child::before { left: 10px; }
.ticks .crowded { color: transparent; } .ticks span::before { border-color: var(--ink-2); }
@media (max-width: 999px) { input { scroll-margin: calc(82px * var(--type, 1) + 24px + min(50vh, 400px)) 0 72px; } } /* between stage and tabs */
@media (max-width: 700px) {
  :host(.docked), .docked, .docked .group { display: contents; } .docked .group > * { margin: 4px 12px; } .docked .group > .dock { display: block; margin: 0; padding-inline: 0; z-index: 3; }
  .docked .dock .below { display: none; } ${dock}
  ${forFingers} .seg button { min-height: 44px; } .link { min-height: 44px; } }
`;

class Group {
  /** @param {Rendering<NumberControlsModel>} rendering */
  constructor(rendering) {
    const { model, el } = rendering, life = lifeOf(rendering);
    this.model = model;
    this.around = [/** @type {ShadowRoot} */ (el.getRootNode()).host, el];
    this.last = ""; // the input that was asked for last
    this.asking = new Asking((count, name, [wish, typed]) => ask(model, [count, name, wish, typed]));
    this.place = part("div", { class: "group" });
    this.frame = part("div", { class: "frame" }, this.place);
    el.replaceChildren(part("style", {}, style), this.frame);
    this.asking.count = JSON.parse(model.state).answered ?? 0;
    followLook(this.frame, life);
    atEnd(life, () => clearTimeout(this.asking.later));
    this.build();
    this.show();
    model.on("state", this.show);
    model.on("parts", () => {
      this.build();
      queueMicrotask(this.show); // the state of these parts comes after them, in the same message
    });
  }

  ask = (name, wish, typed = false) => {
    this.last = name;
    this.asking.ask(name, [wish, typed]);
  };

  build = () => {
    /** @type {Map<string, Control>} */
    this.controls = new Map();
    /** @type {Map<string, Choice>} */
    this.choices = new Map();
    /** @type {Map<string, HTMLElement>} */
    this.parts = new Map();
    this.picks = undefined;
    this.place.replaceChildren(...this.make(JSON.parse(this.model.parts)));
    for (const each of [...this.around, this.frame]) each.classList.toggle("docked", Boolean(this.picks));
  };

  make(parts) {
    return parts.map((given) => {
      const made = this[given.kind](given);
      this.parts.set(given.name ?? given.choice?.name, made);
      return made;
    });
  }

  dock({ label, parts }) {
    const made = this.make(parts);
    this.picks = new Picks([...this.controls.values()], label);
    return part("div", { class: "dock" }, this.picks.element, ...made);
  }

  heading({ text, choice }) {
    return part("div", { class: "titled" }, part("h2", {}, text), ...(choice ? [this.buttons(choice)] : []));
  }

  choice(given) {
    return part("div", { class: "choice", "data-input": given.name }, this.buttons(given));
  }

  buttons({ name, label, options }) {
    const choice = new Choice({ role: "radio", label, kind: "seg", options, choose: (wish) => {
      choice.show(wish);
      this.ask(name, wish);
    } });
    this.choices.set(name, choice);
    return choice.element;
  }

  words() { return part("p", { class: "small" }); }

  number({ name, wording, lines, marks }) {
    const control = new Control(name, wording, this.model.texts, this.ask);
    control.slider.dataset.input = name;
    control.note(" ");
    control.element.style.setProperty("--lines", lines);
    if (marks.length) control.tick(marks);
    this.controls.set(name, control);
    return control.element;
  }

  show = () => {
    const state = JSON.parse(this.model.state);
    this.asking.hear(state.answered);
    for (const [name, element] of this.parts) element.hidden = state.hidden.includes(name);
    for (const [name, html] of Object.entries(state.words)) /** @type {HTMLElement} */ (this.parts.get(name)).innerHTML = html;
    for (const [name, choice] of this.choices) if (!this.isAhead(name)) choice.show(state.values[name]);
    for (const [name, control] of this.controls) {
      control.show(state, this.isAhead(name));
      control.note(state.notes[name] ?? "");
    }
    this.picks?.show();
  };

  // Whether a hand has moved it since the last answer.
  isAhead = (name) => this.last === name && this.asking.isAhead;
}

/** @param {Rendering<NumberControlsModel>} rendering */
export const renderNumberControls = (rendering) => void new Group(rendering);
