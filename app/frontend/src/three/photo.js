// A still picture of a stage for print: drawn again with the given width in px, and with its HTML labels.
import { penOf } from "../data.js";
import { paintWords } from "../paint.js";
/** @import { Labels } from "./labels.js" */
/** @import { Stage } from "./stage.js" */

/** @param {Stage} stage @param {Labels} labels @param {number} wide */
export function photo(stage, labels, wide) {
  const canvas = document.createElement("canvas"), ink = penOf(canvas);
  const still = stage.still(wide), scale = still.width / stage.width;
  canvas.width = still.width;
  canvas.height = still.height;
  ink.drawImage(still, 0, 0);
  ink.scale(scale, scale);
  for (const { element } of labels.all) paintWords(ink, element, stage.holder.getBoundingClientRect());
  return canvas;
}
