// Text at a point in space: HTML over the canvas, so that it is sharp at any zoom.
import { Vector3 } from "three";
import { penOf } from "../data.js";
import { paintWords } from "../paint.js";
import { part } from "../parts.js";
/** @import { Stage } from "./stage.js" */

const projected = new Vector3();

export class Labels {
  /** @param {Stage} stage */
  constructor(stage) {
    this.stage = stage;
    this.layer = part("div", { class: "labels" });
    stage.holder.append(this.layer);
    /** @type {Label[]} */
    this.all = [];
  }

  /** @param {string} html @returns {Label} */
  add(html, className = "") {
    const element = part("span", { class: className, "aria-hidden": "true", style: "display: none" }); // until it has a position
    element.innerHTML = html;
    this.layer.append(element);
    /** @type {Label} */
    const label = { element, at: new Vector3(), shift: [0, 0], visible: true, margin: -Infinity };
    this.all.push(label);
    return label;
  }

  // The picture of the stage for print, with the labels: drawn again, so many px wide.
  /** @param {number} wide @returns {HTMLCanvasElement} */
  photo(wide) {
    const { stage, all } = this, still = stage.still(wide), { width, height } = still, scale = width / stage.width;
    const canvas = part("canvas", { width, height }), ink = penOf(canvas);
    ink.drawImage(still, 0, 0);
    ink.scale(scale, scale);
    for (const { element } of all) paintWords(ink, element, stage.holder.getBoundingClientRect());
    return canvas;
  }

  place() {
    const { camera, width, height } = this.stage;
    camera.updateMatrixWorld();
    const within = (x, most, margin) => Math.max(Math.min(x, most - margin), margin);
    for (const { element, at, shift, visible, margin } of this.all) {
      projected.copy(at).project(camera);
      const shown = visible && Math.abs(projected.z) < 1;
      element.style.display = shown ? "" : "none";
      if (!shown) continue;
      const x = within(((projected.x + 1) / 2) * width + shift[0], width, margin);
      const y = within(((1 - projected.y) / 2) * height + shift[1], height, margin);
      element.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }
}
