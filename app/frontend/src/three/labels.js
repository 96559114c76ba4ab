// Text at a point in space: HTML over the canvas, so that it is sharp at any zoom.
import { Vector3 } from "three";
import { part } from "../widgets/parts.js";
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
