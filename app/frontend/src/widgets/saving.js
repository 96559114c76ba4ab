// A button that saves a file, and how one is saved.
import { colours } from "../colours.js";

const STYLE = `button { font: 500 calc(13px * var(--type, 1)) var(--family, system-ui, sans-serif); padding: 4px 10px; min-height: 31px;
  border: 1px solid; border-radius: 4px; background: transparent; color: var(--link, ${colours.chosen}); cursor: pointer }
  button:hover { background: ${colours.chosen}14 } button[aria-busy=true] { opacity: 0.5; cursor: progress }
  :focus-visible { outline: 2px solid; outline-offset: 2px }`;
const KEPT_MS = 60000;

/** @param {HTMLElement} el @param {string} label */
export function addButton(el, label) {
  const style = document.createElement("style"), button = document.createElement("button");
  style.textContent = STYLE;
  button.textContent = label;
  el.append(style, button);
  return button;
}

/** @param {Blob} blob @param {string} filename */
export function save(blob, filename) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = filename;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
