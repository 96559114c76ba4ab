// Elements of HTML and SVG, a group of buttons of which one is chosen, and numbers in words.
import { fill } from "./data.js";

const DRAWING = "http://www.w3.org/2000/svg";

/** Sets attributes, except those that are undefined or false, and listeners. @param {any} element @param {Record<string, any>} attributes @param {any[]} [children] to be appended */
export function dress(element, attributes, children = []) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element[name] = value;
    else if (typeof value === "object" && name === "style") Object.assign(element.style, value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

/** @param {string} name @param {Record<string, any>} attributes @param {any[]} children @returns {any} */
export const part = (name, attributes = {}, ...children) => dress(document.createElement(name), attributes, children);

/** @param {string} name @param {Record<string, any>} attributes @param {any[]} children @returns {any} */
export const drawn = (name, attributes = {}, ...children) => dress(document.createElementNS(DRAWING, name), attributes, children);

// An equation that can be scrolled by keyboard.
/** @param {string} tex @param {Record<string, any>} attributes @returns {any} */
export function typeset(tex, attributes) {
  const line = part("div", { tabindex: 0, ...attributes });
  if (window.katex) window.katex.render(`\\displaystyle ${tex}`, line, { output: "mathml", throwOnError: false });
  else line.textContent = tex;
  return line;
}

const ICONS = {
  play: "M4.500 2.500v13l11-6.500z", pause: "M4 2h4v14H4zM11 2h4v14h-4z", again: "M4 4v4h4M4.500 8a6 6 0 1 1-.6 4",
  back: "M3 3h2v12H3zM15 3v12L6 9z", forward: "M13 3h2v12h-2zM3 3l9 6-9 6z",
};

// In px; NaN while the element stands nowhere.
/** @param {Element} element */
export const fontSize = (element) => parseFloat(getComputedStyle(element).fontSize);

/** @param {"play" | "pause" | "again" | "back" | "forward"} name */
export const icon = (name) => drawn("svg", { viewBox: "0 0 18 18", width: 18, height: 18, "aria-hidden": "true" },
  drawn("path", { d: ICONS[name], ...(name === "again" ? { fill: "none", stroke: "currentColor", "stroke-width": 2 } : { fill: "currentColor" }) }));

/** @typedef {[name: string | number, word: string, hint?: string][]} Options */

// One of several buttons is chosen; the arrow keys move between them, as between radio buttons.
export class Choice {
  /**
   * @param {object} of
   * @param {"radio" | "tab"} of.role
   * @param {string} of.label
   * @param {string} of.kind class
   * @param {(name: any) => void} of.choose
   * @param {Options} [of.options]
   */
  constructor({ role, label, kind, choose, options = [] }) {
    this.mark = role === "tab" ? "aria-selected" : "aria-checked";
    /** @returns {[string | number, any]} */
    this.make = ([name, word, hint]) => [name, part("button", { type: "button", role, title: hint || undefined, onclick: () => choose(name) }, word)];
    this.element = part("div", { role: role === "tab" ? "tablist" : "radiogroup", class: kind, "aria-label": label, onkeydown: (event) => {
      const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      const all = [...this.buttons.values()], next = all[(all.indexOf(event.target) + by + all.length) % all.length];
      next.focus();
      next.click();
    } });
    this.offer(options);
  }

  // Its buttons are made again when their words change.
  /** @param {Options} options */
  offer(options) {
    const known = JSON.stringify(options);
    if (known === this.known) return;
    this.known = known;
    /** @type {Map<string | number, any>} */
    this.buttons = new Map(/** @type {any[]} */ (options).map(this.make));
    this.element.replaceChildren(...this.buttons.values());
  }

  /** @param {string | number} chosen */
  show(chosen) {
    for (const [name, button] of this.buttons) {
      button.setAttribute(this.mark, String(name === chosen));
      button.tabIndex = name === chosen ? 0 : -1;
    }
  }
}

// Writes a number as in the language of the page, with a true minus sign.
/** @param {number} value @param {number} digits @param {string} decimal */
export function written(value, digits, decimal) {
  const text = Math.abs(value).toFixed(digits);
  return `${value < 0 && Number(text) ? "−" : ""}${text.replace(".", decimal)}`;
}

// Reads a number that a person typed; NaN if it is none.
/** @param {string} text */
export function read(text) {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  return plain === "" ? NaN : Number(plain);
}

// Puts numbers into a text, written as in the language of the page.
/** @param {Record<string, any>} texts @param {string} text @param {Record<string, any>} values */
export const say = ({ decimal }, text, values) =>
  fill(text, Object.fromEntries(Object.entries(values).map(([name, value]) => [name, Array.isArray(value) ? written(value[0], value[1], decimal) : value])));
