// The map of all tops: a/R across and I1/I3 upwards determine which of them can turn over. Each known top is shown as
// its silhouette, which can be clicked; the ring is the top of the page, which can be dragged.
import { fill, local, meets } from "../data.js";
import { clamp } from "../figures/curves.js";
import { lifeOf, onLook } from "../life.js";

// a/R to the right of the gap in the axis; to its left, where ordinary tops are; I1/I3
/** @type {Record<"NEAR" | "FAR" | "RATIO", [from: number, to: number]>} */
const { NEAR, FAR, RATIO } = { NEAR: [-0.03, 0.4], FAR: [-13, -1], RATIO: [0.4, 1.4] };
const LEFT = 44, RIGHT = 10, TOP = 12, BOTTOM = 46, BREAK = 0.22, GAP = 10; // px, except BREAK: a fraction of the width
const NARROW = 640, SIZE = 36, LETTER = 7.2, LINE = 15; // px: below this the map is narrow; a silhouette; a letter; a line
const TICKS = [0, 0.1, 0.2, 0.3, 0.4], FAR_TICKS = [-10, -5], RATIO_TICKS = [0.4, 0.6, 0.8, 1, 1.2, 1.4];

const STYLE = `<style>
  :host { display: block } svg { display: block; width: 100%; height: 100%; font: calc(12px * var(--type, 1)) var(--family, system-ui, sans-serif);
    fill: var(--ink); touch-action: pan-y } .area { --wood: #9a7434 } .axis { fill: var(--faint) }
  .turns { fill: color-mix(in srgb, var(--wood) 50%, var(--card)) } .part { fill: color-mix(in srgb, var(--wood) 26%, var(--card)) }
  .never { fill: color-mix(in srgb, var(--wood) 10%, var(--card)) } .line { stroke: var(--ink); fill: none; stroke-width: 1.5 }
  .group { font-size: calc(18px * var(--type, 1)); font-weight: 600 } .small { font-size: calc(12px * var(--type, 1)) } .known { cursor: pointer; outline: none }
  .known .shape { fill: color-mix(in srgb, var(--ink) 78%, var(--card)); stroke: var(--card); stroke-width: 1.5 }
  .known text { font-weight: 600; paint-order: stroke; stroke: color-mix(in srgb, var(--card) 70%, transparent); stroke-width: 3 } .ring { fill: none; stroke-width: 3.5 } .known:hover .shape, .known:focus .shape { fill: var(--ink) }
  .known:focus-visible .ring.of { stroke: var(--focus); stroke-width: 3 } .here { cursor: grab; touch-action: none; outline: none }
  .here .grip { fill: transparent } .here .ring, .here .line { stroke: var(--link) } .chosen .ring.of { stroke: var(--ink) }
  </style>`;

/** type: the enlargement of the text. @typedef {{ wide: number, high: number, type: number }} Size */

/** Converts between px and a/R, I1/I3. @param {Size} size */
export function scalesOf({ wide, high }) {
  const first = LEFT, split = LEFT + BREAK * (wide - LEFT - RIGHT), last = wide - RIGHT, foot = high - BOTTOM;
  const share = (value, /** @type {[number, number]} */ [low, top]) => (value - low) / (top - low);
  const x = (a) => (a >= NEAR[0] ? split + GAP + share(a, NEAR) * (last - split - GAP) : first + clamp(share(a, FAR), 0, 1) * (split - first));
  const y = (ratio) => foot + share(ratio, RATIO) * (TOP - foot);
  return {
    x, y, split, first, last, foot,
    a: (px) => clamp(NEAR[0] + ((px - split - GAP) / (last - split - GAP)) * (NEAR[1] - NEAR[0]), ...NEAR),
    ratio: (px) => clamp(RATIO[0] + ((px - foot) / (TOP - foot)) * (RATIO[1] - RATIO[0]), ...RATIO),
  };
}

/** The outline, both sides of it, in a square of SIZE around (0, 0). @param {[radius: number, height: number][]} outline */
export function silhouette(outline) {
  const heights = outline.map(([, height]) => height), wide = 2 * Math.max(...outline.map(([radius]) => radius));
  const [low, high] = [Math.min(...heights), Math.max(...heights)], scale = SIZE / Math.max(wide, high - low);
  const at = (side) => ([radius, height]) => `${(side * radius * scale).toFixed(1)} ${((high + low) / 2 - height) * scale}`;
  return `M${[...outline.map(at(1)), ...outline.map(at(-1)).reverse()].join("L")}Z`;
}

// Positions of the names, each in one line beside its silhouette, and whether each overlaps nothing else.
/** @param {{ x: number, y: number, words: string }[]} tops @param {Size} size */
export function placeNames(tops, size) {
  const half = SIZE / 2 + 5, letter = LETTER * size.type, line = LINE * size.type, box = (x, y, wide, high) => ({ left: x, right: x + wide, top: y, bottom: y + high });
  const taken = tops.map(({ x, y }) => box(x - half, y - half, 2 * half, 2 * half));
  return tops.map(({ x, y, words }, own) => {
    const wide = letter * words.length;
    /** @type {[dx: number, dy: number][]} */
    const places = [[half, -line / 2], [-half - wide, -line / 2], [-wide / 2, half], [-wide / 2, -half - line], [half, half - line / 2], [half, -half],
      [-half - wide, half - line / 2], [-half - wide, -half], [-wide / 2, half + line], [-wide / 2, -half - 2 * line]];
    const free = ([dx, dy]) => {
      const name = box(x + dx, y + dy, wide, line);
      return name.left > LEFT && name.right < size.wide && !taken.some((each, k) => k !== own && meets(name, each));
    };
    const found = places.find(free), [dx, dy] = found ?? places[2];
    if (found) taken.push(box(x + dx, y + dy, wide, line));
    return { dx: dx + wide / 2, dy: dy + line / 2, free: Boolean(found) };
  });
}

const attribute = (text) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");

function areas({ x, y, first, split, last, foot }) {
  const [top, zero, end] = [TOP, x(0), NEAR[1]];
  return `<g class="area"><rect class="never" x="${first}" y="${top}" width="${split - first}" height="${foot - top}"/>
    <rect class="never" x="${split + GAP}" y="${top}" width="${last - split - GAP}" height="${foot - top}"/>
    <path class="part" d="M${zero} ${y(1)}L${last} ${y(1 + end)}V${top}H${zero}Z"/>
    <path class="turns" d="M${zero} ${y(1)}L${last} ${y(1 + end)}V${y(1 - end)}Z"/>
    <path class="line" d="M${zero} ${top}V${foot}M${last} ${y(1 + end)}L${zero} ${y(1)}L${last} ${y(1 - end)}"/></g>`;
}

function axes({ x, y, first, foot, last }, words, type) {
  const across = [...FAR_TICKS, ...TICKS].map((a) => `<text x="${x(a)}" y="${foot + 13 * type + 3}" text-anchor="middle">${local(String(a))}</text>`);
  const up = RATIO_TICKS.map((ratio) => `<text x="${first - 6}" y="${y(ratio) + 4}" text-anchor="end">${local(String(ratio))}</text>`);
  const isRoom = LETTER * type * (words.far.length + words.across.length) < last - first;
  const far = isRoom ? `<text x="${first}" y="${foot + 15 * type + 19}">${words.far}</text>` : "";
  return `<g class="axis">${across.join("")}${up.join("")}${far}
    <text x="${last}" y="${foot + 15 * type + 19}" text-anchor="end">${words.across}</text></g>`;
}

function groups({ x, y, first, last }, words, { wide, type }) {
  const narrow = wide / type < NARROW;
  // on a narrow map the first two would overlap on one line
  const places = [["ordinary", narrow ? 4 + first : 10 + first, TOP + (narrow ? 48 : 24), "start"], ["part", x(0) + 20, TOP + 24, "start"],
    ["turns", last - 14, y(0.8), "end"], ["never", x(0) + 20, y(0.46), "start"]];
  return places.map(([name, across, down, anchor]) => {
    const [head, more] = words.groups[name], below = narrow ? "" : `<text x="${across}" y="${down + 18 * type}" text-anchor="${anchor}">${more}</text>`;
    return `<text class="group${narrow ? " small" : ""}" x="${across}" y="${down}" text-anchor="${anchor}">${head}</text>${below}`;
  }).join("");
}

/** @param {TopsMapModel} model @param {Size} size */
export function drawn({ state: { tops, here, chosen }, texts }, size) {
  const scales = scalesOf(size), { x, y } = scales;
  const placed = tops.map((top) => ({ ...top, x: x(top.a), y: clamp(y(top.ratio), TOP, scales.foot), words: top.label }));
  const names = placeNames(placed, size);
  const marks = placed.map((top, k) => `<g class="known${top.name === chosen ? " chosen" : ""}" role="button" tabindex="0"
    data-name="${attribute(top.name)}" aria-label="${attribute(top.label)}" aria-pressed="${top.name === chosen}" transform="translate(${top.x} ${top.y})">
    <circle class="ring of" r="${SIZE / 2 + 7}"/><path class="shape" d="${silhouette(top.outline)}"/>
    ${names[k].free || top.name === chosen ? `<text x="${names[k].dx}" y="${names[k].dy + 4}" text-anchor="middle">${attribute(top.label)}</text>` : ""}</g>`).join("");
  const at = [x(here.a), clamp(y(here.ratio), TOP, scales.foot)], r = SIZE / 2 + 9;
  const own = here.outline ? `<path class="shape" d="${silhouette(here.outline)}"/>` : "";
  const cross = `<path class="line" d="M${scales.first} ${at[1]}H${at[0] - r}M${at[0]} ${scales.foot}V${at[1] + r}"/>`;
  const ring = `<g class="here known" tabindex="0" role="slider" aria-label="${attribute(texts.here)}" aria-valuenow="${here.a}"
    aria-valuetext="${attribute(fill(texts.at, { a: local(here.a.toFixed(3)), ratio: local(here.ratio.toFixed(3)) }))}">${cross}
    <g transform="translate(${at[0]} ${at[1]})">${own}<circle class="grip" r="${r + 6}" pointer-events="stroke" stroke="transparent" stroke-width="14"/><circle class="ring" r="${r}"/></g></g>`;
  return `<svg viewBox="0 0 ${size.wide} ${size.high}" role="group" aria-label="${attribute(texts.label)}">${areas(scales)}${axes(scales, texts, size.type)}${groups(scales, texts, size)}${ring}${marks}</svg>`;
}

const STEPS = { ArrowLeft: [-0.005, 0], ArrowRight: [0.005, 0], ArrowUp: [0, 0.01], ArrowDown: [0, -0.01] };

/** @param {Rendering<TopsMapModel>} rendering */
export function renderTopsMap({ model, el }) {
  el.innerHTML = `${STYLE}<div style="height: 100%"></div>`;
  const place = /** @type {HTMLElement} */ (el.querySelector("div"));
  let size = { wide: 0, high: 0, type: 1 }, held = false;
  const draw = () => {
    const [width, height] = [place.clientWidth, place.clientHeight];
    if (!width || !height || !model.state.tops) return;
    size = { wide: width, high: height, type: parseFloat(getComputedStyle(place).getPropertyValue("--type")) || 1 };
    const focused = /** @type {ShadowRoot} */ (place.getRootNode()).activeElement, name = focused?.getAttribute("data-name"), ring = focused?.matches(".here");
    place.innerHTML = drawn(model, size);
    const again = ring ? place.querySelector(".here") : name && [...place.querySelectorAll(".known")].find((each) => each.getAttribute("data-name") === name);
    /** @type {SVGElement | undefined} */ (again || undefined)?.focus();
  };
  const choose = (name) => {
    model.picked = [(model.picked[0] ?? 0) + 1, name];
  };
  const move = (a, ratio) => {
    model.moved = [(model.moved[0] ?? 0) + 1, a, ratio];
    model.state = { ...model.state, here: { ...model.state.here, a, ratio, outline: null } };
  };
  const named = (event) => /** @type {Element} */ (event.target).closest("[data-name]")?.getAttribute("data-name");
  place.onclick = (event) => named(event) && choose(named(event));
  place.onkeydown = (event) => {
    const step = STEPS[event.key], { a, ratio } = model.state.here, onRing = /** @type {Element} */ (event.target).matches(".here");
    if ((event.key === "Enter" || event.key === " ") && named(event)) choose(named(event));
    else if (onRing && step) move(clamp(a + step[0], ...NEAR), clamp(ratio + step[1], ...RATIO));
    else return;
    event.preventDefault();
  };
  // From the press on, the ring follows the pointer everywhere.
  place.onpointerdown = (event) => {
    if (!(/** @type {Element} */ (event.target).closest(".here"))) return;
    held = true;
    place.setPointerCapture(event.pointerId);
    event.preventDefault();
  };
  place.onpointermove = ({ clientX, clientY }) => {
    if (!held) return;
    const { left, top } = place.getBoundingClientRect(), { a, ratio } = scalesOf(size);
    move(a(clientX - left), ratio(clientY - top));
  };
  place.onpointerup = place.onpointercancel = () => (held = false);
  new ResizeObserver(draw).observe(place);
  model.on("state", draw);
  onLook(draw, lifeOf({ model })); // the font size may have changed
}
