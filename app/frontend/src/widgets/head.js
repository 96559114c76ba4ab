// The row at the top of the page: the top, the tabs, the level, undo, redo, Share, and a menu with everything else.
import { ask } from "../data.js";
import { follow, isDark, lifeOf, onLook } from "../life.js";
import { Choice, part } from "../parts.js";
import { listening } from "../motion/heard.js";
import { headStyle } from "./head_style.js";

// Shows a choice among rows [name, word, ...] that may change.
/** @param {Choice} choice @param {string} chosen @param {any[][]} rows */
function showAmong(choice, chosen, rows) {
  choice.offer(rows.map(([name, word]) => [name, word]));
  choice.show(chosen);
}

class Head {
  /** @param {Rendering<HeadModel>} rendering */
  constructor({ model, el }) {
    const { texts } = model;
    this.model = model;
    this.texts = texts;
    this.count = model.state.answered ?? 0;
    this.toy = part("select", { class: "toy", "aria-label": texts.toy, onchange: () => this.ask("toy", this.toy.value) });
    this.tabs = new Choice({ role: "tab", kind: "tabs", label: texts.tabs, choose: (tab) => this.go(this.roomOf(tab)) });
    const several = (label, choose) => new Choice({ role: "radio", kind: "switch", label, choose });
    this.rooms = several(texts.rooms, (room) => this.goBelow(room));
    this.levels = several(texts.level, (level) => this.goLevel(level));
    this.languages = several(texts.language, (name) => this.ask("language", name));
    this.steps = ["undo", "redo"].map((name) =>
      part("button", { type: "button", class: "icon", "aria-label": texts[name], title: texts[name], onclick: () => this.ask(name) }, texts.signs[name]));
    this.share = part("button", { type: "button", onclick: () => this.ask("share") }, texts.share);
    /** @type {{ name: string, box: HTMLInputElement, element: HTMLElement }[]} */
    this.switches = [];
    this.more = part("button", { type: "button", class: "icon", "aria-label": texts.more, "aria-expanded": "false", onclick: () => this.open(!this.isOpen) }, "⋯");
    this.session = part("div", { class: "session" }, this.levels.element, part("span", {}, ...this.steps, this.share)); // what only a server can do
    this.after = part("div", { class: "after" }, this.session, this.makeMenu());
    this.row = part("header", { class: "row" }, part("h1", {}, texts.title), this.toy, part("nav", { "aria-label": texts.tabs }, this.tabs.element),
      part("span", { class: "grow" }), this.after, this.more);
    this.below = part("div", { class: "rooms" }, this.rooms.element);
    el.replaceChildren(part("style", {}, headStyle), part("div", { class: "all" }, this.row, this.below));
  }

  makeMenu() {
    const { texts } = this;
    this.switches = ["dark", "large"].map((name) => {
      const box = part("input", { type: "checkbox", role: "switch", onchange: () => this.ask(name, box.checked) });
      return { name, box, element: part("label", {}, box, texts[name]) };
    });
    const sound = part("input", { type: "checkbox", role: "switch", onchange: () => (listening.on = sound.checked) });
    const guide = (what) => part("button", { type: "button", hidden: !texts[what], onclick: () => {
      this.open(false);
      window.dispatchEvent(new CustomEvent("tippe:guide", { detail: what }));
    } }, texts[what]);
    this.tour = guide("tour");
    return part("div", { class: "menu", role: "group", "aria-label": texts.more },
      this.languages.element, ...this.switches.map(({ element }) => element), part("label", {}, sound, texts.sound), this.tour, guide("keys"), guide("statement"));
  }

  get isOpen() { return this.more.getAttribute("aria-expanded") === "true"; }

  // What opens stands before its button, and on a narrow page begins with what else stands in the row: the focus goes there.
  /** @param {boolean} whether */
  open(whether) {
    this.more.setAttribute("aria-expanded", String(whether));
    const first = getComputedStyle(this.after).display === "contents" ? this.languages : this.levels;
    if (whether) first.element.querySelector("[tabindex='0']")?.focus();
  }

  // A click elsewhere, or Escape, closes the menu.
  /** @param {Event | KeyboardEvent} event */
  leave = (event) => {
    if (!this.isOpen) return;
    if (event instanceof KeyboardEvent) {
      if (event.key !== "Escape") return;
      this.more.focus();
    } else if (event.composedPath().some((each) => each === this.after || each === this.more)) return;
    this.open(false);
  };

  ask(name, value = "") {
    if (["share", "language", "level"].includes(name) && this.isOpen) {
      this.more.focus(); // the menu would cover what is chosen
      this.open(false);
    }
    ask(this.model, [++this.count, name, value]);
  }

  roomOf(tab) { return this.model.state.tabs.find(([name]) => name === tab)[2]; }

  // Switches the tab at once; Python is told, and creates what does not exist yet.
  turn(room) {
    for (const [name, place] of Object.entries(this.model.state.places)) {
      Bokeh.documents[0].get_model_by_name(place)?.setv({ visible: name === room }, { sync: false });
    }
  }

  go(room) {
    const { tabs } = this.model.state;
    this.turn(room);
    this.tabs.show(tabs.find(([, , first]) => first === room)[0]);
    this.ask("room", room);
  }

  // Another room of the tab.
  goBelow(room) {
    this.turn(room);
    this.rooms.show(room);
    this.ask("room", room);
  }

  goLevel(level) {
    this.levels.show(level);
    this.ask("level", level);
  }

  show() {
    const { state } = this.model;
    if (!state.tabs || state.answered < this.count) return; // newer requests are on their way
    showAmong(this.tabs, state.tab, state.tabs);
    showAmong(this.levels, state.level, state.levels);
    this.session.hidden = !state.levels.length;
    this.below.hidden = !state.rooms.length;
    showAmong(this.rooms, state.room, state.rooms);
    this.share.setAttribute("aria-expanded", String(state.shares));
    this.tour.hidden = !state.tour;
    showAmong(this.languages, state.language, state.languages);
    for (const { name, box } of this.switches) box.checked = state[name];
    for (const [i, isDone] of [state.undo, state.redo].entries()) this.steps[i].disabled = !isDone;
    this.showToys(state);
    this.row.dataset.tab = state.tab;
    this.look();
  }

  look = () => {
    for (const { name, box } of this.switches) if (name === "dark") box.checked = isDark(); // the system's look, unless a person chose
  };

  /** @param {any} state */
  showToys({ toy, toys }) {
    const known = JSON.stringify(toys);
    if (known !== this.known) {
      this.known = known;
      this.toy.replaceChildren(...toys.map(([name, word]) => part("option", { value: name }, word)));
    }
    this.toy.value = toy;
  }
}

/** @param {Rendering<HeadModel>} rendering */
export function renderHead(rendering) {
  const head = new Head(rendering), signal = lifeOf(rendering);
  follow(rendering.model, ["state"], () => head.show());
  for (const type of ["pointerdown", "keydown"]) window.addEventListener(type, head.leave, { signal, capture: true });
  onLook(head.look, signal);
}
