// The selected motion: its tieline in the plane, the same in the plot of K_R, and the bead on both.
import { drawn, dress } from "../parts.js";
/** @import { Plot } from "./scales.js" */

const parts = () => ({
  under: drawn("line", { class: "under" }), bar: drawn("line", { class: "bar" }), mark: drawn("line", { class: "mark" }),
  inner: drawn("circle", { class: "end", r: 5 }), outer: drawn("circle", { class: "end", r: 5 }),
  bead: drawn("circle", { class: "bead", r: 7 }),
});

const put = (line, x1, x2, y1, y2 = y1) => dress(line, { x1, x2, y1, y2 });
const centre = (circle, cx, cy) => dress(circle, { cx, cy });

// In one plot. row: what its vertical axis is.
export class Chosen {
  /** @param {"K_J" | "K_R"} row @param {Record<string, any>} [sliders] attributes of what the keyboard moves */
  constructor(row, sliders) {
    this.row = row;
    /** @type {Plot | null} */
    this.plot = null;
    const { under, bar, mark, inner, outer, bead } = (this.parts = parts());
    const group = (name, ...held) => drawn("g", { class: `grip ${name}`, ...sliders?.[name] }, ...held);
    this.grips = { line: group("line", under, bar, mark), end: group("end", inner, outer), bead: group("bead", bead) };
    this.element = drawn("g", { class: "chosen" }, ...Object.values(this.grips));
  }

  /** @param {Plot} plot @param {Shown} shown */
  show(plot, shown) {
    const { under, bar, mark, inner, outer } = this.parts, { x, y } = plot;
    this.plot = plot;
    this.level = y(shown[this.row]);
    for (const line of [under, bar]) put(line, x(shown.inner), x(shown.outer), this.level);
    put(mark, x(shown.steady), x(shown.steady), this.level - 8, this.level + 8);
    centre(inner, x(shown.inner), this.level);
    centre(outer, x(shown.outer), this.level);
  }

  /** @param {number} theta where the bead is */
  at(theta) {
    if (this.plot) centre(this.parts.bead, this.plot.x(theta), this.level);
  }
}
