// The box around a surface: floor and back walls with a grid, and ticks and names on the edges nearest to the camera.
import * as THREE from "three";
import { local, stepOf } from "../data.js";
import { ticks } from "../motion/curves.js";
/** @import { Labels } from "./labels.js" */
/** @import { Stage } from "./stage.js" */

const DIGITS = [1, 2, 2.5, 5];

// One quantity along an edge of the box: converts values to positions and back. Requires to > from.
export class Scale {
  low = NaN;
  high = NaN;
  step = NaN;
  /** @type {number[]} */
  ticks = [];

  /** @param {number} from @param {number} to */
  constructor(from, to, wanted = 5) {
    this.from = from;
    this.to = to;
    this.wanted = wanted;
    this.set(0, 1);
  }

  /** @param {number} low @param {number} high */
  set(low, high) {
    if (!(high > low)) [low, high] = [low - 0.5, low + 0.5];
    if (low === this.low && high === this.high) return false;
    const step = stepOf((high - low) / this.wanted, DIGITS);
    Object.assign(this, { low, high, step, ticks: ticks(low, high, this.wanted, step) });
    return true;
  }

  // From 0 to a round number just above: it seldom jumps while a slider is dragged.
  setAbove(most) {
    const step = stepOf((most || 1) / this.wanted, DIGITS);
    return this.set(0, step * Math.ceil((most || 1) / step - 1e-6));
  }

  at = (value) => this.from + ((value - this.low) / (this.high - this.low)) * (this.to - this.from);

  value = (place) => this.low + ((place - this.from) / (this.to - this.from)) * (this.high - this.low);

  text(value) {
    const digits = Math.max(0, Math.min(6, -Math.floor(Math.log10(this.step * 1.0001)) + (/25/.test(this.step.toPrecision(2)) ? 1 : 0)));
    return local((Math.abs(value) < 1e-9 * this.step ? 0 : value).toFixed(digits));
  }
}

export class Axes {
  /** @param {Stage} stage @param {Labels} labels @param {Record<Axis, Scale>} scales @param {Record<Axis, string>} names as HTML */
  constructor(stage, labels, scales, names) {
    this.stage = stage;
    this.labels = labels;
    this.scales = scales;
    this.walls = this.edges = 0;
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ vertexColors: true }));
    this.lines.frustumCulled = false;
    stage.scene.add(this.lines);
    /** @type {Record<Axis, Label[]>} */
    this.ticks = { x: [], y: [], z: [] };
    const name = (axis) => labels.add(names[axis], "axis");
    this.names = { x: name("x"), y: name("y"), z: name("z") };
  }

  /** @param {{ walls: number, edges: number }} look */
  dress({ walls, edges }) {
    this.walls = walls;
    this.edges = edges;
    this.place(true);
  }

  // Puts the walls behind and the numbers in front, for the present camera.
  place(force = false) {
    const { camera, controls } = this.stage;
    const eye = camera.position.clone().sub(controls.target);
    const sides = [Math.sign(eye.x) || 1, Math.sign(eye.y) || -1];
    const key = sides.join();
    if (!force && key === this.key) return;
    this.key = key;
    const { x, y, z } = this.scales;
    const [front, back] = [(scale, side) => (side > 0 ? scale.to : scale.from), (scale, side) => (side > 0 ? scale.from : scale.to)];
    const nearX = front(x, sides[0]), farX = back(x, sides[0]), nearY = front(y, sides[1]), farY = back(y, sides[1]);

    const points = [], colours = [];
    const line = (grey, ...ends) => {
      points.push(...ends);
      for (let i = 0; i < 2; i++) colours.push(grey, grey, grey * 1.04);
    };
    const { walls: GRID, edges: EDGE } = this;
    for (const value of x.ticks) {
      const at = x.at(value);
      line(GRID, at, y.from, 0, at, y.to, 0);
      line(GRID, at, farY, 0, at, farY, z.to);
    }
    for (const value of y.ticks) {
      const at = y.at(value);
      line(GRID, x.from, at, 0, x.to, at, 0);
      line(GRID, farX, at, 0, farX, at, z.to);
    }
    for (const value of z.ticks) {
      const at = z.at(value);
      line(GRID, farX, y.from, at, farX, y.to, at);
      line(GRID, x.from, farY, at, x.to, farY, at);
    }
    line(EDGE, x.from, nearY, 0, x.to, nearY, 0);
    line(EDGE, nearX, y.from, 0, nearX, y.to, 0);
    // Of the two vertical edges at the sides of the picture, the left one has the numbers.
    const right = new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
    /** @type {[x: number, y: number]} */
    const upright = right.x * nearX + right.y * farY < right.x * farX + right.y * nearY ? [nearX, farY] : [farX, nearY];
    line(EDGE, ...upright, 0, ...upright, z.to);
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry();
    this.lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.lines.geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));

    const out = (value, by) => value + Math.sign(value) * by;
    this.write("x", (at) => [at, out(nearY, 0.1), 0], [(x.from + x.to) / 2, out(nearY, 0.36), 0]);
    this.write("y", (at) => [out(nearX, 0.1), at, 0], [out(nearX, 0.36), (y.from + y.to) / 2, 0]);
    this.write("z", (at) => [out(upright[0], 0.07), out(upright[1], 0.07), at], [...upright, z.to]);
    this.names.z.shift = [6, -20];
  }

  /** @param {Axis} axis @param {(at: number) => XYZ} where @param {XYZ} nameAt */
  write(axis, where, nameAt) {
    const scale = this.scales[axis], pool = this.ticks[axis];
    while (pool.length < scale.ticks.length) pool.push(this.labels.add("", "tick"));
    pool.forEach((label, i) => {
      label.visible = i < scale.ticks.length && !(axis === "z" && i === 0); // its 0 would overlap another axis's number
      if (!label.visible) return;
      label.element.textContent = scale.text(scale.ticks[i]);
      label.at.set(...where(scale.at(scale.ticks[i])));
    });
    this.names[axis].at.set(...nameAt);
  }
}
