// The friction cone.
import * as THREE from "three";
import { colours } from "../colours.js";
import { WideLine } from "./lines.js";

// Height 1 and radius 1, standing on its tip; scaled to the cone of the moment.
export function frictionCone() {
  const group = new THREE.Group();
  const see = { color: colours.friction, transparent: true, depthTest: false, depthWrite: false };
  const side = new THREE.Mesh(
    new THREE.ConeGeometry(1, 1, 48, 1, true).rotateX(-Math.PI / 2).translate(0, 0, 0.5),
    new THREE.MeshBasicMaterial({ ...see, opacity: 0.16, side: THREE.DoubleSide }),
  );
  const rim = new WideLine({ ...see, linewidth: 2, opacity: 0.8 });
  rim.setPath(65, (i, put) => put(Math.cos((i * Math.PI) / 32), Math.sin((i * Math.PI) / 32), 1));
  group.add(side, rim);
  for (const part of group.children) part.renderOrder = 2;
  return group;
}
