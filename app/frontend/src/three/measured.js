// The axis of the top as seen on a film: a dashed line through the centre of the ball. Rows t, x, y, z, in units of the
// top's time.
import { float32, rowBefore } from "../data.js";
import { followScene } from "./scene.js";
import { WideLine } from "./lines.js";
/** @import { Stage } from "./stage.js" */
/** @import { Labels } from "./labels.js" */
/** @import { Body } from "./body.js" */

const WIDTH = 4;
const REACH = 1.7; // R: length of the line from the centre, in both directions
const DASHES = 17, DASH = 0.6; // of the line, and which fraction of each is drawn
const GAP = 4; // in units of the usual time between two rows: in a longer gap nothing was measured

/** @param {Float32Array} rows @param {number} t @returns {Spot | null} the row before t, and what share of the way to the
 * next; null where nothing was measured */
export function rowAt(rows, t) {
  const count = rows.length / WIDTH, time = (i) => rows[i * WIDTH];
  if (count < 2) return null;
  const usual = (time(count - 1) - time(0)) / (count - 1);
  if (t < time(0) - usual || t > time(count - 1) + usual) return null;
  const low = rowBefore(rows, t, WIDTH), long = time(low + 1) - time(low);
  return long > GAP * usual ? null : [low, Math.min(Math.max((t - time(low)) / (long || 1), 0), 1)];
}

export class Measured {
  /** @param {Stage} stage @param {Labels} labels @param {TopModel} model @param {AbortSignal} life */
  constructor(stage, labels, model, life) {
    this.model = model;
    this.halo = new WideLine({ color: 0xffffff, linewidth: 5, transparent: true, opacity: 0.85, depthTest: false });
    this.line = new WideLine({ color: 0x000000, linewidth: 2, transparent: true, depthTest: false });
    this.halo.renderOrder = 5;
    this.line.renderOrder = 6;
    this.label = labels.add("", "measured");
    stage.scene.add(this.halo, this.line);
    this.rows = new Float32Array();
    followScene(({ sky, ink }) => {
      this.halo.material.color.set(sky);
      this.line.material.color.set(ink);
      stage.invalidate();
    }, life);
  }

  read() {
    this.rows = float32(this.model.measured);
    this.label.element.textContent = this.model.measured_label ?? "";
  }

  /** @param {Body} body @param {number} t */
  follow(body, t) {
    const spot = body.visible ? rowAt(this.rows, t) : null;
    this.halo.visible = this.line.visible = this.label.visible = Boolean(spot);
    if (!spot) return;
    const [row, share] = spot, axis = [1, 2, 3].map((k) => {
      const one = this.rows[row * WIDTH + k], other = this.rows[(row + 1) * WIDTH + k];
      return one + share * (other - one);
    });
    const far = REACH / (Math.hypot(...axis) || 1), { x, y, z } = body.position, [a, b, c] = axis.map((part) => part * far);
    const put = (part, to) => to(x + a * part, y + b * part, z + c * part);
    this.halo.setPath(2, (i, to) => put(2 * i - 1, to));
    this.line.setSegments(DASHES, (i, to) => {
      put(2 * i / DASHES - 1, to);
      put(2 * (i + DASH) / DASHES - 1, to);
    });
    const up = c < 0 ? -1 : 1;
    this.label.at.set(x + up * a * 1.06, y + up * b * 1.06, z + up * c * 1.06);
    this.label.shift = [0, -10];
  }
}
