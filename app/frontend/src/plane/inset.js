// A tieline that is too short to be seen is also shown enlarged, in a corner of the plane.
import { degrees, fill, local } from "../data.js";
import { drawn } from "../parts.js";
import { Chosen } from "./chosen.js";
import { across, region, shortly, upwards } from "./drawing.js";
import { plotOf } from "./scales.js";
import { write } from "./words.js";
/** @import { Box } from "../data.js" @import { Plot } from "./scales.js" */
/** @import { PlaneScene } from "./plane.js" */

const WIDE = 200, HIGH = 92, EDGE = 10; // px
const AROUND = 0.7, LEVELS = 0.06; // shown beyond either end, in the tieline's lengths; of the range of K_J, either way

export class Inset {
  constructor() {
    this.chosen = new Chosen("K_J");
    this.element = drawn("g", { class: "inset" });
    /** @type {Box | null} */
    this.box = null;
    this.drawn = "";
  }

  // Where it is, if it is there.
  /** @param {Plot} plane @param {PlaneScene} scene @returns {Box | null} */
  place({ box: { left, right, bottom } }, { state, size }) {
    const right_ = right - EDGE, low = bottom - EDGE;
    return state.near ? { left: right_ - Math.min(WIDE, 0.6 * (right - left)), right: right_, top: low - HIGH - 3.6 * size, bottom: low } : null;
  }

  /** @param {Plot} plane @param {PlaneScene} scene @param {boolean} isAnew whether more than the motion has changed */
  show(plane, scene, isAnew) {
    const { state } = scene, box = (this.box = this.place(plane, scene)), says = box ? [state.inner, state.outer, state.K_J].join() : "";
    if (!isAnew && this.drawn === says) return;
    this.drawn = says;
    this.element.replaceChildren(...(box ? this.parts(box, scene) : []));
  }

  /** @param {Box} box @param {PlaneScene} scene */
  parts(box, { state, limits, size, texts }) {
    const inner = { left: box.left + 3 * size, right: box.right - size, top: box.top + 3 * size, bottom: box.bottom - 1.7 * size };
    const around = Math.max(AROUND * (state.outer - state.inner), 1e-3), [low, high] = state.K_J_range, by = LEVELS * (high - low);
    /** @type {[number, number][]} */
    const [along, up] = [[state.inner - around, state.outer + around], [state.K_J - by, state.K_J + by]];
    const plot = plotOf(inner, along, up), wording = (tilt) => local(degrees(tilt).toFixed(1));
    this.chosen.show(plot, state);
    const text = fill(texts.near[wording(state.inner) === wording(state.outer) ? "stays" : "says"], { inner: wording(state.inner), outer: wording(state.outer) });
    return [
      drawn("rect", { class: "card", x: box.left, y: box.top, width: box.right - box.left, height: box.bottom - box.top, rx: 6 }),
      drawn("clipPath", { id: "near" }, drawn("rect", { x: inner.left, y: inner.top, width: inner.right - inner.left, height: inner.bottom - inner.top })),
      ...upwards(plot, up, 2, size, shortly), ...across(plot, along, 3, size, shortly),
      drawn("g", { "clip-path": "url(#near)", class: "curves" }, ...region(plot, limits)), this.chosen.element,
      write({ text, kind: "", place: { x: (box.left + box.right) / 2, y: box.top + 1.3 * size, side: "middle" } }, size),
    ];
  }
}
