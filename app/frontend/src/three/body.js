// The top: its outline rotated about axis 3, painted so that its spin is visible.
import * as THREE from "three";
import { colours } from "../colours.js";
import { penOf } from "../data.js";

const AROUND = 56;
const PAINT = "#8f2313"; // belongs to no quantity
const CORNER = 0.35; // rad: a sharper bend than this is an edge of the wood, not a curve

// Rows of (radius, height, normal r, normal z, fraction of the outline's length); a corner has two rows, one for each
// side.
/** @param {Float32Array} profile */
function outline(profile) {
  const n = profile.length >> 1;
  const points = Array.from({ length: n }, (_, i) => [profile[2 * i], profile[2 * i + 1]]);
  if (n && points[0][1] > points[n - 1][1]) points.reverse(); // from the bottom up
  const edges = [];
  for (let i = 0; i + 1 < points.length; i++) {
    const dr = points[i + 1][0] - points[i][0], dz = points[i + 1][1] - points[i][1];
    const length = Math.hypot(dr, dz);
    if (length > 1e-6) edges.push({ from: points[i], to: points[i + 1], length, normal: [dz / length, -dr / length] });
  }
  const total = edges.reduce((sum, edge) => sum + edge.length, 0);
  const rows = [];
  let along = 0, firstCorner = 1;
  const push = ([r, z], [nr, nz]) => rows.push([r, z, nr, nz, along / total]);
  edges.forEach((edge, i) => {
    const before = edges[i - 1];
    if (!before) push(edge.from, [0, -1]);
    else {
      const cosine = edge.normal[0] * before.normal[0] + edge.normal[1] * before.normal[1];
      if (Math.acos(Math.min(cosine, 1)) > CORNER) {
        firstCorner = Math.min(firstCorner, along / total);
        push(edge.from, before.normal);
        push(edge.from, edge.normal);
      } else {
        const sum = [edge.normal[0] + before.normal[0], edge.normal[1] + before.normal[1]];
        const length = Math.hypot(...sum);
        push(edge.from, [sum[0] / length, sum[1] / length]);
      }
    }
    along += edge.length;
    if (i === edges.length - 1) push(edge.to, edge.normal);
  });
  return { rows, firstCorner };
}

function revolve(rows) {
  const positions = [], normals = [], uvs = [], index = [];
  for (const [r, z, nr, nz, v] of rows) {
    for (let k = 0; k <= AROUND; k++) {
      const angle = (2 * Math.PI * k) / AROUND, x = Math.cos(angle), y = Math.sin(angle);
      positions.push(r * x, r * y, z);
      normals.push(nr * x, nr * y, nz);
      uvs.push(k / AROUND, v);
    }
  }
  const across = AROUND + 1;
  for (let j = 0; j + 1 < rows.length; j++) {
    for (let k = 0; k < AROUND; k++) {
      const a = j * across + k, b = a + across;
      index.push(a, a + 1, b, b, a + 1, b + 1);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(uvs, 2));
  geometry.setIndex(index);
  return geometry;
}

// A small random number generator with a fixed seed: the wood always looks the same.
function grainSource(seed) {
  return () => {
    seed = (seed * 1664525 + 1013904223) >>> 0;
    return seed / 2 ** 32;
  };
}

// Across: once around axis 3. Up: along the outline; firstCorner is where the sphere ends and the side of the stem
// begins.
function paint(firstCorner) {
  const canvas = document.createElement("canvas");
  const width = (canvas.width = 1024), height = (canvas.height = 512);
  const pen = penOf(canvas);
  const random = grainSource(7);
  const edge = height * (1 - firstCorner); // y of the rim of the sphere; y grows downwards
  const level = (share) => height - share * (height - edge); // fraction of the sphere's outline, from its bottom

  pen.fillStyle = colours.wood;
  pen.fillRect(0, 0, width, height);
  for (let i = 0; i < 420; i++) {
    // Grain along the axis, as in a top that was turned on a lathe.
    const x = random() * width;
    pen.fillStyle = random() < 0.55 ? `rgba(140, 84, 34, ${0.05 + 0.13 * random()})` : `rgba(255, 228, 184, ${0.16 * random()})`;
    pen.fillRect(x, 0, 0.8 + 4 * random(), height);
  }
  pen.fillStyle = "rgba(96, 52, 20, 0.55)";
  pen.fillRect(0, 0, width, edge); // the cut and the stem are darker wood

  const band = (from, to, style) => {
    pen.fillStyle = style;
    pen.fillRect(0, level(to), width, level(from) - level(to));
  };
  const meridian = (centre, half, from, to, style) => {
    pen.fillStyle = style;
    pen.fillRect((centre - half) * width, level(to), 2 * half * width, level(from) - level(to));
  };
  for (const centre of [0.5, 0.75]) meridian(centre, 0.007, 0, 1, "#5a3312");
  meridian(0.25, 0.07, 0, 0.985, "#f7f3ea"); // the bold mark: one side only
  meridian(0.25, 0.047, 0, 0.985, PAINT);
  band(0.7, 0.715, "#5a3312");
  band(0.73, 0.79, PAINT);
  band(0.805, 0.82, "#5a3312");
  // A round spot opposite, drawn wider where the circles of latitude are short.
  pen.fillStyle = "#f7f3ea";
  pen.beginPath();
  pen.ellipse(0.625 * width, level(0.5), 0.033 * width, 0.075 * (height - edge), 0, 0, 2 * Math.PI);
  pen.fill();

  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.wrapS = THREE.RepeatWrapping;
  return texture;
}

/** @extends {THREE.Mesh<THREE.BufferGeometry, THREE.MeshPhongMaterial>} */
export class Body extends THREE.Mesh {
  constructor() {
    super(new THREE.BufferGeometry(), new THREE.MeshPhongMaterial({ shininess: 70, specular: 0x3a3a3a }));
    this.castShadow = true;
  }

  /** @param {Float32Array} profile (radius, height above O along axis 3) pairs */
  setProfile(profile) {
    const { geometry: old, material } = this;
    old.dispose();
    material.map?.dispose();
    const { rows, firstCorner } = outline(profile);
    this.geometry = revolve(rows);
    material.map = paint(firstCorner);
    material.needsUpdate = true;
    this.reach = rows.reduce((most, [r, z]) => Math.max(most, Math.hypot(r, z)), 1); // from O to the farthest point
    this.top = rows.reduce((most, [, z]) => Math.max(most, z), 0); // and to the end of the axis
  }
}
