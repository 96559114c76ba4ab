// An arrow that stays visible inside the body: where something hides it, it is drawn paler.
import * as THREE from "three";

const up = new THREE.Vector3(0, 0, 1);
const direction = new THREE.Vector3();

export class Arrow extends THREE.Group {
  /** @param {THREE.ColorRepresentation} colour */
  constructor(colour, { radius = 0.035, through = 0.55 } = {}) {
    super();
    this.radius = radius;
    const shaft = new THREE.CylinderGeometry(1, 1, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const head = new THREE.ConeGeometry(1, 1, 20).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    // Both passes count as transparent, so that they are drawn after the table and the body, and in this order.
    /** @type {[THREE.MeshBasicMaterial, THREE.MeshLambertMaterial]} */
    this.passes = [
      new THREE.MeshBasicMaterial({
        transparent: true, opacity: through, depthFunc: THREE.GreaterDepth, depthWrite: false,
      }),
      new THREE.MeshLambertMaterial({ transparent: true }),
    ];
    this.parts = this.passes.map((material, pass) => {
      const part = { shaft: new THREE.Mesh(shaft, material), head: new THREE.Mesh(head, material) };
      for (const mesh of Object.values(part)) {
        mesh.renderOrder = 2 + pass;
        this.add(mesh);
      }
      return part;
    });
    this.colour = colour;
  }

  set colour(colour) {
    for (const material of this.passes) material.color.set(colour);
    // Emits a little light, so that even its shaded side has the colour of the legend.
    this.passes[1].emissive.set(colour).multiplyScalar(0.45);
  }

  // From origin along (x, y, z), in units of the scene; tip is set to its end.
  /** @param {THREE.Vector3} origin @param {number} x @param {number} y @param {number} z @param {THREE.Vector3} tip */
  point(origin, x, y, z, tip) {
    direction.set(x, y, z);
    tip.copy(origin).add(direction);
    const length = direction.length();
    this.drawable = length > 1e-3;
    if (!this.drawable) return;
    this.position.copy(origin);
    this.quaternion.setFromUnitVectors(up, direction.divideScalar(length));
    const head = Math.min(6.5 * this.radius, 0.5 * length);
    const width = (head / 6.5) * 2.6;
    for (const part of this.parts) {
      part.shaft.scale.set(this.radius, this.radius, length - head);
      part.head.position.z = length - head;
      part.head.scale.set(width, width, head);
    }
  }
}
