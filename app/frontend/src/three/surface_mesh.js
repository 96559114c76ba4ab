// The surface of Fig. 5: a mesh over theta and K_J, one row for each tieline.
import * as THREE from "three";
import { nearestRow } from "../figures/curves.js";
/** @import { Scale } from "./axes.js" */

// From light to dark in even steps of OKLCH lightness, from yellow to brown: no line has one of these hues.
const RAMP = ["#f8f2dd", "#eed8a8", "#e5bb76", "#da9f4a", "#cc8325", "#b8690f", "#9f5414", "#81421e", "#623422"].map((hex) => new THREE.Color(hex));

/** @param {number} share of the greatest height @param {THREE.Color} shade set to the result */
function shadeAt(share, shade) {
  // As the root of the height, so that the low part, most of the surface, has different shades too.
  const place = Math.min(Math.sqrt(Math.max(share, 0)) * (RAMP.length - 1), RAMP.length - 1.001), k = Math.floor(place);
  return shade.lerpColors(RAMP[k], RAMP[k + 1], place - k);
}

// The data from Python: rows of equal K_J, with theta varying along each.
export class Grid {
  /** @param {{ K_J: Float32Array, theta: Float32Array, height: Float32Array, energy: Float32Array }} data */
  constructor({ K_J, theta, height, energy }) {
    this.K_J = K_J;
    this.theta = theta;
    this.height = height;
    this.energy = energy;
    this.rows = K_J.length;
    this.columns = this.rows ? Math.floor(theta.length / this.rows) : 0;
  }

  // Whether a row is a motion; otherwise the surface has a gap there.
  /** @param {number} row */
  isReal(row) {
    return Number.isFinite(this.height[row * this.columns]) && Number.isFinite(this.theta[row * this.columns]);
  }

  // The index of the point closest to a place on the floor, if that is on the tieline of its row; otherwise null.
  /** @param {[theta: number, K_J: number]} place */
  on([theta, K_J]) {
    const row = nearestRow(this.K_J, K_J), tilts = this.theta.subarray(row * this.columns, (row + 1) * this.columns);
    return theta >= tilts[0] && theta <= tilts[tilts.length - 1] ? row * this.columns + nearestRow(tilts, theta) : null;
  }

  // Writes pairs of triangles between the rows to `index`; unused ones have no area.
  /** @param {Uint32Array} index */
  fillTriangles(index) {
    const { rows, columns } = this;
    let used = 0;
    for (let i = 0; i + 1 < rows; i++) {
      if (!this.isReal(i) || !this.isReal(i + 1)) continue;
      for (let j = 0; j + 1 < columns; j++) {
        const a = i * columns + j, b = a + columns;
        index.set([a, a + 1, b, b, a + 1, b + 1], used);
        used += 6;
      }
    }
    index.fill(0, used);
  }
}

export class SurfaceMesh {
  /** @param {Record<Axis, Scale>} scales @param {THREE.Plane[]} clippingPlanes */
  constructor(scales, clippingPlanes) {
    const material = new THREE.MeshLambertMaterial({
      vertexColors: true, side: THREE.DoubleSide, clippingPlanes,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    this.object = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.scales = scales;
    this.corner = new THREE.Vector3();
  }

  // Geometry for a number of points: the present one, if it has that many.
  /** @param {Grid} grid */
  sized({ rows, columns }) {
    const count = rows * columns;
    if (this.object.geometry.attributes.position?.count === count) return this.object.geometry;
    this.object.geometry.dispose();
    const geometry = (this.object.geometry = new THREE.BufferGeometry());
    for (const name of ["position", "normal", "color"]) geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(6 * Math.max(rows - 1, 0) * Math.max(columns - 1, 0)), 1));
    return geometry;
  }

  /** @param {Grid} grid */
  show(grid) {
    const geometry = this.sized(grid), { x, y, z } = this.scales, { position, color } = geometry.attributes;
    const shade = new THREE.Color(), { K_J, theta, height, rows, columns } = grid;
    for (let i = 0, at = 0; i < rows; i++) {
      const there = grid.isReal(i), b = y.at(K_J[i]);
      for (let j = 0; j < columns; j++, at++) {
        position.setXYZ(at, there ? x.at(theta[at]) : 0, b, there ? z.at(height[at]) : 0);
        shadeAt(there ? height[at] / z.high : 0, shade);
        color.setXYZ(at, shade.r, shade.g, shade.b);
      }
    }
    const triangles = /** @type {THREE.BufferAttribute} */ (geometry.index);
    grid.fillTriangles(/** @type {Uint32Array} */ (triangles.array));
    for (const attribute of [triangles, position, color]) attribute.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere(); // raycasting needs it
  }

  // The index of the mesh point closest to where a ray meets the mesh, or null.
  /** @param {THREE.Raycaster} ray */
  nearest(ray) {
    const hit = ray.intersectObject(this.object, false).find(({ point }) => point.x <= this.scales.x.to + 1e-6);
    if (!hit) return null;
    const { position } = this.object.geometry.attributes, { a, b, c } = /** @type {THREE.Face} */ (hit.face);
    const distance = (i) => this.corner.fromBufferAttribute(position, i).distanceToSquared(hit.point);
    return [a, b, c].reduce((best, i) => (distance(i) < distance(best) ? i : best));
  }
}
