// A still picture of a stage for print: drawn again with the given width in px, and with its HTML labels.
import { penOf } from "../data.js";
/** @import { Labels } from "./labels.js" */
/** @import { Stage } from "./stage.js" */

/** @param {Stage} stage @param {Labels} labels @param {number} wide */
export function photo(stage, labels, wide) {
  const canvas = document.createElement("canvas"), ink = penOf(canvas);
  const still = stage.still(wide), scale = still.width / stage.width;
  canvas.width = still.width;
  canvas.height = still.height;
  ink.drawImage(still, 0, 0);
  ink.textAlign = "center";
  ink.textBaseline = "middle";
  ink.lineJoin = "round";
  const holder = stage.holder.getBoundingClientRect();
  for (const { element } of labels.all) {
    if (element.style.display === "none") continue;
    const box = element.getBoundingClientRect();
    const { fontStyle, fontWeight, fontFamily, fontSize, color, textShadow } = getComputedStyle(element);
    ink.font = `${fontStyle} ${fontWeight} ${scale * parseFloat(fontSize)}px ${fontFamily}`;
    /** @type {[number, number]} */
    const at = [scale * (box.x - holder.x + box.width / 2), scale * (box.y - holder.y + box.height / 2)];
    ink.strokeStyle = textShadow.match(/^rgba?\([^)]*\)/)?.[0] ?? "white";
    ink.lineWidth = 3 * scale;
    ink.strokeText(element.textContent, ...at);
    ink.fillStyle = color;
    ink.fillText(element.textContent, ...at);
  }
  return canvas;
}
