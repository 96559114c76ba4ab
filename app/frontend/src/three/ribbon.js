// A path painted on the table: a flat strip whose points can change, and of which a first part can be drawn.
import * as THREE from "three";

/** @extends {THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>} */
export class Ribbon extends THREE.Mesh {
  /** @param {number} width @param {THREE.MeshBasicMaterialParameters} material */
  constructor(width, material) {
    super(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ transparent: true, depthWrite: false, side: THREE.DoubleSide, ...material }));
    this.halfWidth = width / 2;
    this.frustumCulled = false;
  }

  reserve(points) {
    if (!grow(this, 2 * points)) return;
    const index = [];
    for (let i = 0; i + 1 < points; i++) index.push(2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    this.geometry.setIndex(index);
  }

  // (x, y) pairs, all at one height.
  /** @param {number} n @param {(i: number) => [x: number, y: number]} xy @param {number} height */
  setPath(n, xy, height) {
    this.reserve(n);
    this.points = n;
    if (!n) return;
    const { position } = this.geometry.attributes;
    for (let i = 0; i < n; i++) {
      const [x0, y0] = xy(Math.max(i - 1, 0)), [x, y] = xy(i), [x1, y1] = xy(Math.min(i + 1, n - 1));
      const length = Math.hypot(x1 - x0, y1 - y0) || 1;
      const dx = ((y1 - y0) / length) * this.halfWidth, dy = ((x1 - x0) / length) * this.halfWidth;
      position.setXYZ(2 * i, x + dx, y - dy, height);
      position.setXYZ(2 * i + 1, x - dx, y + dy, height);
    }
    position.needsUpdate = true;
  }

  set points(n) {
    this.geometry.setDrawRange(0, Math.max(6 * (n - 1), 0));
    this.visible = n > 1;
  }
}

// Gives a mesh room for so many points, if it has less: a buffer cannot be resized once it has been drawn.
function grow(mesh, points) {
  if (points <= (mesh.geometry.attributes.position?.count ?? 0)) return false;
  mesh.geometry.dispose();
  mesh.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * points), 3));
  return true;
}

// A line one pixel wide, in space.
/** @extends {THREE.Line<THREE.BufferGeometry, THREE.LineBasicMaterial>} */
export class Thread extends THREE.Line {
  /** @param {THREE.LineBasicMaterialParameters} material */
  constructor(material) {
    super(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ transparent: true, depthWrite: false, ...material }));
    this.frustumCulled = false;
  }

  /** @param {number} n @param {Points} point */
  setPath(n, point) {
    grow(this, n);
    this.points = n;
    if (!n) return;
    const { geometry: { attributes: { position } } } = this;
    for (let i = 0; i < n; i++) point(i, (x, y, z) => position.setXYZ(i, x, y, z));
    position.needsUpdate = true;
  }

  set points(n) {
    this.geometry.setDrawRange(0, n);
    this.visible = n > 1;
  }
}
