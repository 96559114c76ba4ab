// The table that the top stands on, and part of the top's shadow.
import * as THREE from "three";
import { penOf } from "../data.js";

export const TABLE = 26; // the table's radius, in R: there it has faded into the sky

// A disc that fades into the sky, below a grid with a line every R and a bolder one every 5 R. Plain colours and lines:
// a texture, or lighting computed for each pixel, would cost more than all the rest of the picture.
export function makeTable() {
  const disc = new THREE.CircleGeometry(TABLE, 48);
  disc.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(3 * disc.attributes.position.count), 3));
  const table = new THREE.Mesh(
    disc,
    // The background of everything, never seen from below: it is drawn first, and everything else over it.
    new THREE.MeshBasicMaterial({ vertexColors: true, fog: false, depthTest: false, depthWrite: false }),
  );
  table.renderOrder = -3;
  for (const strong of [false, true]) {
    const ends = [];
    for (let at = 1 - TABLE; at < TABLE; at++) {
      if ((at % 5 === 0) !== strong) continue;
      const half = Math.floor(Math.sqrt(TABLE ** 2 - at ** 2) / 2) * 2;
      // In short pieces: some software renderers drop a line that begins behind the camera.
      for (let from = -half; from < half; from += 2) ends.push(at, from, 0, at, from + 2, 0, from, at, 0, from + 2, at, 0);
    }
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
    const grid = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ depthTest: false, depthWrite: false }));
    grid.renderOrder = -2;
    table.add(grid);
  }
  return table;
}

/** @param {any} table from makeTable @param {Record<"sky" | "table" | "grid" | "strong", number>} look */
export function dressTable(table, look) {
  const { color } = table.geometry.attributes, colour = new THREE.Color();
  for (let i = 0; i < color.count; i++) colour.set(i ? look.sky : look.table).toArray(color.array, 3 * i);
  color.needsUpdate = true;
  table.children.forEach((grid, strong) => grid.material.color.set(strong ? look.strong : look.grid));
}

// The soft dark spot below a round object on a table: with the shadow map alone, the contact seems to float.
export function blobMaterial() {
  const canvas = document.createElement("canvas");
  const side = (canvas.width = canvas.height = 128);
  const pen = penOf(canvas);
  const fade = pen.createRadialGradient(side / 2, side / 2, 0, side / 2, side / 2, side / 2);
  fade.addColorStop(0, "rgba(40, 34, 26, 0.6)");
  fade.addColorStop(0.35, "rgba(40, 34, 26, 0.25)");
  fade.addColorStop(1, "rgba(40, 34, 26, 0)");
  pen.fillStyle = fade;
  pen.fillRect(0, 0, side, side);
  return new THREE.MeshBasicMaterial({ map: new THREE.CanvasTexture(canvas), transparent: true, depthWrite: false });
}
