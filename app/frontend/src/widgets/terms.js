// The glossary on the page: explains a term that the mouse rests on, or a finger taps, in any sentence.
import { hideReadout, showReadout } from "../figures/readout.js";
import { sketchOf } from "./sketches.js";

/** @typedef {Record<string, { forms: string, is: string }>} Terms */

const REST = 350; // ms
const QUIET = "button, a, input, select, textarea, option, label, summary, svg, [title], [role=slider], [contenteditable]";

/** Finds the terms of a glossary: (text) => [{ name, at, end }]. @param {Terms} terms */
export function finder(terms) {
  const names = new Map();
  for (const [name, { forms }] of Object.entries(terms)) for (const form of forms.split("|")) names.set(form.toLowerCase(), name);
  const longestFirst = [...names.keys()].sort((one, other) => other.length - one.length);
  const escaped = longestFirst.map((form) => form.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  const every = new RegExp(`(?<![\\p{L}\\d-])(?:${escaped.join("|")})(?![\\p{L}\\d-])`, "giu");
  return (/** @type {string} */ text) =>
    [...text.matchAll(every)].map((found) => ({ name: names.get(found[0].toLowerCase()), at: found.index, end: found.index + found[0].length }));
}

/** The explanation of a term, as HTML. @param {Terms} terms @param {string} name */
export const readoutOf = (terms, name) => `${sketchOf(name) ?? ""}<div><b>${terms[name].forms.split("|")[0]}</b>: ${terms[name].is}.</div>`;

// The term at a place in an element's own text, and the boxes around it.
function termAt(element, x, y, find) {
  for (const node of element.childNodes) {
    if (node.nodeType !== Node.TEXT_NODE) continue;
    for (const { name, at, end } of find(node.data)) {
      const range = document.createRange();
      range.setStart(node, at);
      range.setEnd(node, end);
      const boxes = [...range.getClientRects()];
      if (boxes.some((box) => x >= box.left && x <= box.right && y >= box.top && y <= box.bottom)) return { name, boxes };
    }
  }
  return undefined;
}

/** @param {Terms} terms @param {AbortSignal} signal */
export function watchTerms(terms, signal) {
  const owner = {}, find = finder(terms);
  let resting = 0;
  const look = (element, x, y) => {
    if (!(element instanceof Element) || element.closest(QUIET)) return;
    const found = termAt(element, x, y, find);
    if (found) showReadout(owner, readoutOf(terms, found.name), [x, y], found.boxes);
  };
  const away = () => {
    clearTimeout(resting);
    hideReadout(owner);
  };
  document.addEventListener("pointermove", (event) => {
    away();
    if (event.pointerType === "touch" || event.buttons) return;
    const [element] = event.composedPath();
    resting = setTimeout(look, REST, element, event.clientX, event.clientY);
  }, { passive: true, signal });
  document.addEventListener("pointerdown", away, { signal });
  document.addEventListener("click", (event) => {
    if (event instanceof PointerEvent && event.pointerType === "touch") look(event.composedPath()[0], event.clientX, event.clientY);
  }, { signal });
  window.addEventListener("scroll", away, { capture: true, passive: true, signal });
  signal.addEventListener("abort", away);
}
