// The paper's Fig. 4 at a moment: the section through contact and axis, and the two lever arms of a push at the
// contact.
import { drawn, dress } from "../parts.js";
import { float32 } from "../data.js";

/** @typedef {[number, number]} Point */
const ROW = 6; // numbers for each moment: the axis, G, and the foot of the perpendicular to the axis, seen from the contact

// A point of the outline where the axis points there; O is above the contact, which is at (0, 0).
/** @param {Point} point @param {Point} axis @returns {Point} */
export const turned = ([across, along], [e, f]) => [across * f + along * e, 1 - across * e + along * f];

export class Arms {
  /** @param {Record<string, string>} wording */
  constructor(wording) {
    this.rows = new Float32Array(0);
    this.outline = /** @type {Point[]} */ ([]); // across the axis, and along it from O
    /** @type {(point: Point) => Point} */
    this.put = (point) => point;
    this.scale = 1; // px in one R
    this.hull = drawn("path", { class: "hull" });
    this.axis = drawn("path", { class: "axis thin" });
    this.upwards = drawn("path", { class: "axis thin" });
    this.own = drawn("path", { class: "arm-own" });
    this.upright = drawn("path", { class: "arm-upright" });
    this.push = drawn("g", {}, drawn("circle", { r: 8, class: "pushed" }), drawn("circle", { r: 2.5, class: "mass" }));
    this.mass = drawn("circle", { r: 4, class: "mass" });
    this.words = {
      own: drawn("text", { class: "word halo own" }, wording.own), upright: drawn("text", { class: "word halo" }, wording.upright),
      push: drawn("text", { class: "halo" }, wording.push), axis: drawn("text", { class: "halo" }, wording.axis), mass: drawn("text", { class: "halo" }, wording.mass),
    };
  }

  /** @param {LessonRun} run @param {number} width @param {number} height */
  draw(run, width, height) {
    const profile = float32(run.profile), side = Array.from({ length: profile.length >> 1 }, (_, i) => /** @type {Point} */ ([profile[2 * i], profile[2 * i + 1]]));
    this.rows = float32(run.arms);
    this.outline = [...side, ...side.map(([r, z]) => /** @type {Point} */ ([-r, z])).reverse()];
    const scale = Math.min(width / 5.4, height / 2.9), x0 = width / 2, y0 = height - 22;
    this.scale = scale;
    this.put = ([x, y]) => /** @type {Point} */ ([x0 + scale * x, y0 - scale * y]);
    return [this.hull, drawn("path", { class: "table", d: `M8 ${y0}H${width - 8}` }), this.upwards, this.axis, this.own, this.upright, this.mass,
      this.push, ...Object.values(this.words)];
  }

  /** @param {Point[]} points */
  path = (...points) => points.map((point, i) => `${i ? "L" : "M"}${this.put(point).map((v) => v.toFixed(1)).join(" ")}`).join("");

  /** @param {any} element @param {Point} point @param {number} dx @param {number} dy @param {string} anchor */
  word(element, point, dx, dy, anchor) {
    const [x, y] = this.put(point);
    dress(element, { x: x + dx, y: y + dy, "text-anchor": anchor });
  }

  /** @param {number} moment a row of the run's curves */
  at(moment) {
    const { rows, words, path } = this, i = ROW * Math.min(moment, rows.length / ROW - 1);
    if (i < 0) return;
    const point = (k) => /** @type {Point} */ ([rows[i + k], rows[i + k + 1]]), [axis, G, foot] = [point(0), point(2), point(4)];
    const tip = /** @type {Point} */ ([1.75 * axis[0], 1 + 1.75 * axis[1]]);
    dress(this.hull, { d: `${path(...this.outline.map((each) => turned(each, axis)))}Z` });
    dress(this.axis, { d: path([-1.2 * axis[0], 1 - 1.2 * axis[1]], tip) });
    dress(this.upwards, { d: path([G[0], 0], [G[0], 2.3]) });
    dress(this.own, { d: path([0, 0], foot) });
    dress(this.upright, { d: path([0, 0.02], [G[0], 0.02]) });
    dress(this.mass, { transform: `translate(${this.put(G).join(" ")})` });
    dress(this.push, { transform: `translate(${this.put([0, 0]).join(" ")})` });
    const clear = 14 / this.scale; // px above the line of the table, in R
    const side = G[0] <= 0 ? 1 : -1, [near, far] = side > 0 ? ["start", "end"] : ["end", "start"];
    this.word(words.push, [0, 0], 0, 20, "middle");
    if (foot[0] * side < 0 && foot[1] < 0.5) { // both arms on one side: only the longer one has its word there
      this.word(words.upright, [0, 0], 14 * side, -8, near);
      this.word(words.own, [foot[0], Math.max(foot[1], clear)], -12 * side, 4, far);
    } else {
      this.word(words.upright, [G[0], 0], -14 * side, -8, far);
      this.word(words.own, [0.6 * foot[0], Math.max(0.6 * foot[1], clear)], 12 * side, 4, near);
    }
    this.word(words.axis, tip, 8, 4, "start");
    this.word(words.mass, G, -10 * side, 4, far);
  }
}
