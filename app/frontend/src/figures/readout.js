// The values at a place of a figure, in one box for all figures: beside the pointer, inside the window, and never over
// what it describes.
import { part } from "../parts.js";

const GAP = 14, EDGE = 6; // px from the pointer or from what must stay visible, and from the edge of the window
const STYLE = {
  position: "fixed", zIndex: 1500, pointerEvents: "none", maxWidth: "min(280px, calc(100vw - 12px))", padding: "6px 10px", borderRadius: "6px",
  font: "calc(12px * var(--type, 1))/1.5 var(--family, system-ui, sans-serif)", color: "var(--ink)", background: "var(--card)", border: "1px solid var(--faint)",
};

/** @import { Box } from "../data.js" */

/** @param {Box} a @param {Box} b */
const shared = (a, b) =>
  Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));

// Where to put a box of a given size: beside the pointer, or above or below what must stay visible. The first place
// that covers none of it is taken, otherwise the one that covers least.
/**
 * @param {[x: number, y: number]} hand
 * @param {{ wide: number, high: number }} size
 * @param {{ wide: number, high: number }} page
 * @param {Box[]} clear
 */
export function placeBeside([x, y], { wide, high }, page, clear) {
  const inside = (value, size, most) => Math.max(EDGE, Math.min(value, most - size - EDGE));
  const own = { left: x - GAP / 2, right: x + GAP / 2, top: y - GAP / 2, bottom: y + GAP / 2 }, kept = [own, ...clear];
  const level = y - high / 2, middle = x - wide / 2;
  const places = [[x + GAP, level], [x - GAP - wide, level], [middle, y - GAP - high], [middle, y + GAP],
    ...kept.flatMap((each) => [[middle, each.top - GAP - high], [middle, each.bottom + GAP], [each.right + GAP, level], [each.left - GAP - wide, level]])];
  let found = { left: 0, top: 0 }, least = Infinity;
  for (const [across, down] of places) {
    const left = inside(across, wide, page.wide), top = inside(down, high, page.high);
    const box = { left, top, right: left + wide, bottom: top + high };
    const covered = kept.reduce((sum, each) => sum + shared(box, each), 0);
    if (covered < least) [found, least] = [{ left, top }, covered];
  }
  return found;
}

/** @type {HTMLElement | undefined} */
let box;
/** @type {object | undefined} */
let owner;

function boxOf() {
  if (!box?.isConnected) {
    box = /** @type {HTMLElement} */ (part("div", { class: "tippe-readout", style: STYLE }));
    document.body.append(box);
  }
  return box;
}

// whose: must be passed again to hide the box. Python sends the words.
/** @param {object} whose @param {string} words as HTML @param {[x: number, y: number]} hand in px of the window @param {Box[]} clear what must stay visible */
export function showReadout(whose, words, hand, clear) {
  const shown = boxOf(), { style } = shown;
  owner = whose;
  if (shown.innerHTML !== words) shown.innerHTML = words;
  style.display = "";
  const { left, top } = placeBeside(hand, { wide: shown.offsetWidth, high: shown.offsetHeight },
    { wide: innerWidth, high: innerHeight }, clear);
  Object.assign(style, { left: `${left}px`, top: `${top}px` });
  return shown;
}

/** @param {object} whose */
export function hideReadout(whose) {
  if (box && owner === whose) box.style.display = "none";
}
