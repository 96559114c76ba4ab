// Words in a drawing: typeset, and placed beside what they name where they cover nothing.
import { meets } from "../data.js";
import { drawn } from "../parts.js";

const WIDE = 0.53, LINE = 1.25, ASCENT = 0.95, BELOW = 0.2; // of the font size: mean width of a letter, from line to line, above the base line, below a line with an index

/** @import { Box } from "../data.js" */
/** @typedef {{ x: number, y: number, side: "start" | "middle" | "end", to?: [x: number, y: number] }} Place y: base line of the first line; to: where a line leads */
/** @typedef {{ says: string[], places: Place[], kind?: string }} Name says: of several the first that finds room */
/** @typedef {{ text: string, place: Place, box: Box, kind: string }} Placed */

const plain = (html) => html.replace(/<[^>]*>/g, "");

/** @param {string} text @param {Place} place @param {number} size @returns {Box} */
export function boxOf(text, { x, y, side }, size) {
  const lines = text.split("\n"), wide = WIDE * size * Math.max(...lines.map((line) => plain(line).length));
  const left = x - wide * { start: 0, middle: 0.5, end: 1 }[side], top = y - ASCENT * size;
  return { left, right: left + wide, top, bottom: top + LINE * size * lines.length + (text.includes("<sub>") ? BELOW * size : 0) };
}

const isInside = (a, b) => a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;

// Gives each name the first place where it is inside and covers nothing; a name without one is left out. The earlier
// lists of what must not be covered may be ignored if there is no other way, the last one never.
/** @param {Name[]} names @param {Box[][]} taken @param {Box} inside @param {number} size @returns {Placed[]} */
export function place(names, taken, inside, size) {
  /** @type {Placed[]} */
  const found = [];
  for (const { says, places, kind = "" } of names) {
    const ways = taken.flatMap((_, i) => says.flatMap((text) => places.map((each) => ({ text, place: each, kind, box: boxOf(text, each, size), kept: taken.slice(i).flat() }))));
    const way = ways.find(({ box, kept }) => isInside(box, inside) && ![...kept, ...found.map((other) => other.box)].some((other) => meets(box, other)));
    if (way) found.push(way);
  }
  return found;
}

// Letters of formulas, from <i> and <sub>.
/** @param {string} html */
function typeset(html) {
  let below = false;
  return html.split(/(<i>.*?<\/i>|<sub>.*?<\/sub>)/).filter(Boolean).map((piece) => {
    const mark = /^<(i|sub)>/.exec(piece)?.[1], isSub = mark === "sub", dy = isSub ? "0.3em" : below ? "-0.22em" : undefined;
    below = isSub;
    return drawn("tspan", { dy, class: mark }, plain(piece));
  });
}

/** @param {Omit<Placed, "box">} placed @param {number} size */
export const write = ({ text, place: { x, y, side, to }, kind }, size) => drawn("g", { class: `name ${kind}` },
  ...(to ? [drawn("path", { class: "lead", d: `M${side === "end" ? x + 3 : x - 3} ${y - 0.35 * size}L${to[0]} ${to[1]}` })] : []),
  ...text.split("\n").map((line, i) => drawn("text", { class: "halo", x, y: y + i * LINE * size, "text-anchor": side }, ...typeset(line))));
