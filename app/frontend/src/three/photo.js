// A still picture of a stage for print: drawn again with the given width in px, and with its HTML labels.
import { penOf } from "../data.js";
import { paintWords } from "../paint.js";
import { part } from "../widgets/parts.js";
/** @import { Labels } from "./labels.js" */
/** @import { Stage } from "./stage.js" */

/** @param {Stage} stage @param {Labels} labels @param {number} wide */
export function photo(stage, labels, wide) {
  const still = stage.still(wide), { width, height } = still, scale = width / stage.width;
  const canvas = part("canvas", { width, height }), ink = penOf(canvas);
  ink.drawImage(still, 0, 0);
  ink.scale(scale, scale);
  for (const { element } of labels.all) paintWords(ink, element, stage.holder.getBoundingClientRect());
  return canvas;
}
