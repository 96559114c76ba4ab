// The top: its outline rotated about axis 3, painted so that its spin is visible.
import * as THREE from "three";
import { colours } from "../colours.js";
import { penOf } from "../data.js";

const AROUND = 56;
const PAINT = "#8f2313"; // belongs to no quantity
const CORNER = 0.35; // rad: a sharper bend than this is an edge of the wood, not a curve

// The surface of revolution of an outline, which has an edge where a point stands twice; the fraction of the outline at
// which the first edge is; and its points.
/** @param {Float32Array} profile */
function revolved(profile) {
  const given = Array.from({ length: profile.length >> 1 }, (_, i) => new THREE.Vector2(profile[2 * i], profile[2 * i + 1]));
  if (given.length && given[0].y > given[given.length - 1].y) given.reverse(); // from the bottom up
  const outline = given.filter((point, i) => !i || point.distanceTo(given[i - 1]) > 1e-6);
  const pieces = outline.slice(1).map((point, i) => point.clone().sub(outline[i])), points = [], lengths = [];
  let length = 0, smooth = 0; // of all, and to the first edge
  outline.forEach((point, i) => {
    const isEdge = i > 0 && i < pieces.length && pieces[i - 1].angleTo(pieces[i]) > CORNER;
    if (isEdge) smooth ||= length;
    points.push(...(isEdge ? [point, point] : [point]));
    lengths.push(...(isEdge ? [length, length] : [length]));
    length += pieces[i]?.length() ?? 0;
  });
  const geometry = new THREE.LatheGeometry(points, AROUND).rotateX(Math.PI / 2).rotateZ(Math.PI / 2), { uv } = geometry.attributes;
  geometry.normalizeNormals();
  for (let i = 0; i < uv.count; i++) uv.setY(i, lengths[i % points.length] / length);
  return { geometry, points, firstCorner: smooth ? smooth / length : 1 };
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
    this.profile = /** @type {Float32Array | undefined} */ (undefined); // what it has been built of
  }

  /** @param {Float32Array} profile (radius, height above O along axis 3) pairs */
  setProfile(profile) {
    const { geometry: old, material, profile: built } = this;
    if (built?.length === profile.length && profile.every((number, i) => number === built[i])) return; // as of the motion before
    this.profile = profile;
    old.dispose();
    material.map?.dispose();
    const { geometry, points, firstCorner } = revolved(profile);
    this.geometry = geometry;
    material.map = paint(firstCorner);
    material.needsUpdate = true;
    this.reach = Math.max(1, ...points.map((point) => point.length())); // from O to the farthest point
    this.top = Math.max(0, ...points.map(({ y }) => y)); // and to the end of the axis
  }
}
