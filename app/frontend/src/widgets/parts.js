// Elements of HTML and SVG, and a group of buttons of which one is chosen.
const DRAWING = "http://www.w3.org/2000/svg";

function dress(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element[name] = value;
    else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

/** @param {string} name @param {Record<string, any>} attributes @param {any[]} children @returns {any} */
export const part = (name, attributes = {}, ...children) => dress(document.createElement(name), attributes, children);

/** @param {string} name @param {Record<string, any>} attributes @param {any[]} children @returns {any} */
export const drawn = (name, attributes = {}, ...children) => dress(document.createElementNS(DRAWING, name), attributes, children);

// One of several buttons is chosen; the arrow keys move between them, as between radio buttons.
export class Choice {
  /**
   * @param {object} of
   * @param {"radio" | "tab"} of.role
   * @param {string} of.label
   * @param {[name: string | number, word: string, hint: string][]} of.options
   * @param {(name: any) => void} of.choose
   */
  constructor({ role, label, options, choose }) {
    this.mark = role === "tab" ? "aria-selected" : "aria-checked";
    this.buttons = new Map(options.map(([name, word, hint]) =>
      [name, part("button", { type: "button", role, title: hint || undefined, onclick: () => choose(name) }, word)]));
    this.element = part("div", { role: role === "tab" ? "tablist" : "radiogroup", "aria-label": label }, ...this.buttons.values());
    this.element.onkeydown = (event) => {
      const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      const all = [...this.buttons.values()], next = all[(all.indexOf(event.target) + by + all.length) % all.length];
      next.focus();
      next.click();
    };
  }

  /** @param {string | number} chosen */
  show(chosen) {
    for (const [name, button] of this.buttons) {
      button.setAttribute(this.mark, String(name === chosen));
      button.tabIndex = name === chosen ? 0 : -1;
    }
  }
}
