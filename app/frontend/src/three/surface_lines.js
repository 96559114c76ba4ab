// The lines of Fig. 5: curves of some rows and their tielines on the floor, the limits, and the selected motion.
import * as THREE from "three";
import { colours } from "../colours.js";
import { float32 } from "../data.js";
import { WideLine } from "./lines.js";
import { colourOf } from "../regimes.js";
/** @import { Scale } from "./axes.js" */
/** @import { Grid } from "./surface_mesh.js" */
/** @import { Labels } from "./labels.js" */

const INK = 0x1d2733; // on the surface, which is light on a dark page too
const CURVES = 26; // about this many of the rows have their curve and tieline drawn

/** @param {THREE.ColorRepresentation} colour @param {number} radius */
export function dot(colour, radius) {
  const sphere = new THREE.Mesh(new THREE.SphereGeometry(radius, 16, 12), new THREE.MeshBasicMaterial({ color: colour }));
  sphere.visible = false;
  return sphere;
}

export class SurfaceLines {
  /** @param {THREE.Scene} scene @param {Labels} labels @param {Record<Axis, Scale>} scales @param {THREE.Plane[]} clippingPlanes */
  constructor(scene, labels, scales, clippingPlanes) {
    const wide = (color, linewidth) => new WideLine({ color, linewidth, clippingPlanes });
    // What lies on the floor under the surface shows through, paler.
    const through = (color, linewidth, opacity = 0.35) => new WideLine({
      color, linewidth, clippingPlanes, transparent: true, opacity, depthFunc: THREE.GreaterDepth, depthWrite: false,
    });
    this.scales = scales;
    this.curves = new WideLine({ color: INK, linewidth: 1, transparent: true, opacity: 0.6, clippingPlanes });
    this.floor = {
      tielines: [wide(0, 1.2), through(INK, 1.2)],
      verge: [wide(colours.normal, 2.6), through(colours.normal, 2.6)],
      steady: [wide(0, 2.2), through(INK, 2.2)],
      selected: [wide(colours.theta, 4.5), through(colours.theta, 4.5, 0.6)],
    };
    this.selectedCurves = [wide(colours.theta, 4.5), through(colours.theta, 4.5, 0.6)];
    const pairs = [...Object.values(this.floor), this.selectedCurves];
    for (const [, hidden] of pairs) hidden.renderOrder = 1;
    this.pole = dot(0, 0.028);
    this.poleLabel = labels.add("<i>P</i>", "point");
    this.poleLabel.shift = [12, -12];
    scene.add(this.pole, this.curves, ...pairs.flat());
  }

  /** @param {{ lines: number, ink: number }} look */
  dress({ lines, ink }) {
    this.floor.tielines[0].material.color.set(lines);
    for (const { material } of [this.floor.steady[0], this.pole]) material.color.set(ink);
  }

  /** @param {Grid} grid */
  showRows(grid) {
    const { x, y, z } = this.scales, { K_J, theta, height, rows, columns } = grid;
    const every = Math.max(1, Math.round(rows / CURVES)), drawn = [];
    for (let i = 0; i < rows; i++) if (grid.isReal(i) && (i % every === 0 || i === rows - 1)) drawn.push(i);
    const pieces = Math.max(columns - 1, 0);
    this.curves.setSegments(drawn.length * pieces, (s, put) => {
      const i = drawn[Math.floor(s / pieces)], at = i * columns + (s % pieces);
      for (const a of [at, at + 1]) put(x.at(theta[a]), y.at(K_J[i]), z.at(height[a]));
    });
    for (const line of this.floor.tielines) {
      line.setSegments(drawn.length, (s, put) => {
        const i = drawn[s];
        for (const a of [i * columns, (i + 1) * columns - 1]) put(x.at(theta[a]), y.at(K_J[i]), 0);
      });
    }
  }

  // Pairs of (theta, K_J). The line has a gap where an end is missing.
  /** @param {"verge" | "steady"} name @param {Float32Array} points */
  showLimit(name, points) {
    const { x, y } = this.scales, joined = [];
    for (let i = 0; i + 3 < points.length; i += 2) if (points.subarray(i, i + 4).every(Number.isFinite)) joined.push(i);
    for (const line of this.floor[name]) {
      line.setSegments(joined.length, (s, put) => {
        for (const a of [joined[s], joined[s] + 2]) put(x.at(points[a]), y.at(points[a + 1]), 0.002);
      });
    }
  }

  /** @param {Grid} grid @param {SurfaceModel} model @param {string} colour that of the limit */
  show(grid, model, colour) {
    this.showRows(grid);
    this.showLimit("verge", float32(model.verge));
    this.showLimit("steady", float32(model.steady));
    for (const line of this.floor.verge) line.material.color.set(colour);
    const { pole, poleLabel, scales: { x, y, z } } = this, [theta, K_J, height] = float32(model.P);
    pole.visible = poleLabel.visible = Number.isFinite(height) && K_J >= y.low && K_J <= y.high;
    if (!pole.visible) return;
    pole.position.set(x.at(theta), y.at(K_J), z.at(height));
    poleLabel.at.copy(pole.position);
  }

  // The selected motion: its tieline, and its curve as pairs of (theta, height).
  /** @param {Tieline} tieline @param {Float32Array} curve @param {number} worst */
  showSelected({ K_J, inner, outer }, curve, worst) {
    const { x, y, z } = this.scales, inBox = Number.isFinite(K_J) && K_J >= y.low && K_J <= y.high;
    for (const line of [...this.floor.selected, ...this.selectedCurves]) line.material.color.set(colourOf(worst));
    for (const line of this.floor.selected) {
      line.setSegments(inBox ? 1 : 0, (s, put) => {
        for (const end of [inner, outer]) put(x.at(end), y.at(K_J), 0.004);
      });
    }
    for (const line of this.selectedCurves) {
      line.setPath(inBox ? curve.length >> 1 : 0, (i, put) => put(x.at(curve[2 * i]), y.at(K_J), z.at(curve[2 * i + 1])));
    }
  }
}
