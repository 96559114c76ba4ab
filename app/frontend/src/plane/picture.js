// The drawing of Fig. 6: a layer for what stands still, one for the path of a motion that slips, and the selected motion.
import { ROLLS } from "../regimes.js";
import { drawn } from "../parts.js";
import { Chosen } from "./chosen.js";
import { across, region, shortly, slipping, touchBoxes, touchLine, upwards } from "./drawing.js";
import { Inset } from "./inset.js";
import { curveNames, pathBoxes, pathNames, regionBoxes, tielineName } from "./names.js";
import { boxesOf, padded, plotOf } from "./scales.js";
import { place, write } from "./words.js";
/** @import { Box } from "../data.js" @import { Plot } from "./scales.js" */
/** @import { PlaneScene } from "./plane.js" */

const layer = (name) => drawn("g", { class: name });

const clip = (id, { left, right, top, bottom }, by = 0) => drawn("clipPath", { id },
  drawn("rect", { x: left - by, y: top - by, width: right - left + 2 * by, height: bottom - top + 2 * by }));

export class Picture {
  /** @param {Record<string, Record<string, any>>} sliders attributes of what the keyboard moves */
  constructor(sliders) {
    this.chosen = new Chosen("K_J", sliders);
    this.below = new Chosen("K_R");
    this.inset = new Inset();
    this.layers = { base: layer("base"), routh: layer("base"), path: layer("path"), words: layer("words"), name: layer("words") };
    const { base, routh, path, words, name } = this.layers;
    this.clips = drawn("defs");
    this.element = drawn("svg", { role: "group" }, this.clips, base, routh, path, this.inset.element, words, name,
      drawn("g", { "clip-path": "url(#plane)" }, this.chosen.element), this.below.element);
    const empty = plotOf({ left: 0, right: 0, top: 0, bottom: 0 }, [0, 1], [0, 1]);
    /** @type {{ plane: Plot, routh: Plot }} */
    this.plots = { plane: empty, routh: empty };
    /** @type {[number, number]} */
    this.up = [NaN, NaN]; // the range of K_R
    /** @type {Box[]} */
    this.placed = []; // where names are
  }

  // isAnew: all of it; goes: the path is another one.
  /** @param {PlaneScene} scene @param {boolean} isAnew @param {boolean} goes */
  show(scene, isAnew, goes) {
    if (isAnew) this.drawBase(scene);
    this.drawRouth(scene, isAnew, goes);
    if (goes) {
      this.drawPath(scene);
      this.name(scene);
    }
    this.inset.show(this.plots.plane, scene, isAnew);
    this.chosen.show(this.plots.plane, scene.state);
    this.below.show(this.plots.routh, scene.state);
    this.nameTieline(scene);
  }

  drawBase({ width, height, size, state, limits }) {
    const boxes = boxesOf(width, height, size), plane = plotOf(boxes.plane, state.theta_range, state.K_J_range), { x, y, box } = plane;
    this.plots = { plane, routh: plotOf(boxes.routh, state.theta_range, [-1, 1]) };
    this.element.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.clips.replaceChildren(clip("curves", box), clip("plane", box, 12), clip("routh", boxes.routh, 4));
    const count = Math.max(2, (box.bottom - box.top) / (4.2 * size)), half = x(Math.PI / 2);
    this.layers.base.replaceChildren(
      ...upwards(plane, state.K_J_range, count, size, shortly),
      ...(half < box.right ? [drawn("line", { class: "half", x1: half, x2: half, y1: box.top, y2: box.bottom })] : []),
      drawn("g", { "clip-path": "url(#curves)", class: "curves" }, ...region(plane, limits)),
      drawn("line", { class: "axis", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom }),
      drawn("circle", { class: "pole", cx: x(0), cy: y(state.pole), r: 4 }), drawn("text", { class: "word halo", x: x(0) + 8, y: y(state.pole) - 4 }, "P"),
    );
  }

  // The range of K_R depends on where the motion goes. Without a path it stays while K_R is in it: it is under a hand.
  /** @param {PlaneScene} scene @param {boolean} isAnew @param {boolean} goes */
  drawRouth({ state, path, size }, isAnew, goes) {
    const values = path ? path.K_R : [state.K_R], low = Math.min(0, ...values), high = Math.max(0, ...values), { routh } = this.plots;
    const fits = !path && this.up[0] < low && this.up[1] > high;
    if (fits && !isAnew) return;
    if (path && !goes && !isAnew) return;
    if (!fits) this.up = padded(low, high);
    const { box } = routh, plot = (this.plots.routh = plotOf(box, state.theta_range, this.up)), wide = (box.right - box.left) / (4 * size);
    this.layers.routh.replaceChildren(
      ...upwards(plot, this.up, 3, size, shortly), ...across(plot, state.theta_range, Math.max(3, Math.min(7, wide)), size, shortly),
      drawn("line", { class: "axis", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom }),
    );
  }

  drawPath({ path, state }) {
    const { plane, routh } = this.plots;
    this.layers.path.replaceChildren(...(path ? [
      ...touchLine(plane, path, state), drawn("g", { "clip-path": "url(#plane)" }, slipping(plane, path, "K_J", state.touches)),
      drawn("g", { "clip-path": "url(#routh)" }, slipping(routh, path, "K_R", state.touches)),
    ] : []));
  }

  // The names of the curves and of the path; they stay while a motion is pulled.
  /** @param {PlaneScene} scene */
  name(scene) {
    const { path, state, limits, size, texts } = scene, { plane, routh } = this.plots, { x, y, box } = plane;
    const around = (left, right, level, by) => ({ left: x(left) - by, right: x(right) + by, top: y(level) - by, bottom: y(level) + by });
    const corner = this.inset.place(plane, scene);
    const fixed = [around(state.inner, state.outer, state.K_J, 10), ...(corner ? [corner] : []), around(0, 0, state.pole, 1.5 * size)];
    const goes = path ? pathNames(this.plots, path, state, texts, size) : { first: [], last: [], routh: [] };
    const soft = path ? pathBoxes(plane, path.theta, path.K_J) : [], wall = path ? touchBoxes(plane, path, state) : [];
    // that of the tieline is the first, so that it finds room; it is written on its own, since it moves
    fixed.push(...place([tielineName(plane, state, scene.way, size)], [fixed.slice(1)], { ...box, top: box.top - size }, size).map((each) => each.box));
    const placed = place([...goes.first, ...curveNames(plane, limits, texts, state.mu_s, size), ...goes.last],
      [regionBoxes(plane, limits), wall, soft, fixed], { ...box, top: box.top - size }, size);
    const low = place(goes.routh, [path ? pathBoxes(routh, path.theta, path.K_R) : [], []], { ...routh.box, right: routh.box.right + size }, size);
    this.placed = placed.map((each) => each.box);
    this.layers.words.replaceChildren(...[...placed, ...low].map((each) => write(each, size)));
  }

  nameTieline({ state, size, way }) {
    const { plane } = this.plots, inside = { ...plane.box, top: plane.box.top - size };
    const found = place([tielineName(plane, state, way, size)], [this.placed, []], inside, size);
    this.layers.name.replaceChildren(...found.map((each) => write(each, size)));
    for (const { element } of [this.chosen, this.below, this.inset.chosen]) element.classList.toggle("not", state.worst !== ROLLS);
  }

  /** @param {number} theta where the bead is */
  at(theta) {
    for (const each of [this.chosen, this.below, this.inset.chosen]) each.at(theta);
  }
}
