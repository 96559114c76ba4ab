// A button that saves a file, and the function that does it.
import { colours } from "../colours.js";

const STYLE = `button { font: calc(14px * var(--type, 1)) var(--family, system-ui, sans-serif);
  padding: 0 12px; min-width: 76px; min-height: calc(36px * var(--type, 1)); border: 1px solid var(--faint, #8b949e);
  border-radius: 6px; background: transparent; color: var(--ink, ${colours.ink}); cursor: pointer }
  button:hover { background: color-mix(in srgb, currentColor 8%, transparent) } button[aria-busy=true] { opacity: 0.5; cursor: progress }
  :focus-visible { outline: 2px solid; outline-offset: 2px } @media (max-width: 700px) { button { min-height: 44px } }`;
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
