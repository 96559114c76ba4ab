// The top without WebGL: seen from the side, so that its tilt is true to scale, and played by the same bar.
import { Vector3 } from "three";
import { Bar } from "./bar.js";
import { Place } from "../motion/clock.js";
import { colours } from "../colours.js";
import { coalesce, float32, local, penOf } from "../data.js";
import { centreOf, emptyPose } from "../motion/frames.js";
import { wordOf } from "../regimes.js";
import { report } from "../life.js";
import { followScene } from "./scene.js";
import { part } from "../parts.js";

const LEAST_REACH = 1.6, BELOW = 0.6; // R: the least height shown above O, and what is shown below the table
const WIDTH = 640; // px: width of a printed picture if the one on the page has no size

const centre = new Vector3();

// The outline of a body whose radius is R px, tilted about O at (x, y), with a mark that turns with the body.
/** @param {CanvasRenderingContext2D} pen @param {Float32Array} profile @param {{ x: number, y: number, R: number, tilt: number, turn: number, edge: string }} place */
function drawBody(pen, profile, { x, y, R, tilt, turn, edge }) {
  const n = profile.length >> 1;
  pen.save();
  pen.translate(x, y);
  pen.rotate(tilt);
  pen.beginPath();
  for (let i = 0; i < n; i++) pen.lineTo(R * profile[2 * i], -R * profile[2 * i + 1]);
  for (let i = n - 1; i >= 0; i--) pen.lineTo(-R * profile[2 * i], -R * profile[2 * i + 1]);
  pen.closePath();
  pen.fillStyle = colours.wood;
  pen.strokeStyle = edge;
  pen.lineWidth = 2;
  pen.fill();
  pen.stroke();
  pen.setLineDash([8, 5]);
  pen.beginPath();
  pen.moveTo(0, 1.2 * R);
  pen.lineTo(0, -1.8 * R);
  pen.stroke();
  pen.setLineDash([]);
  if (Math.cos(turn) > 0) {
    pen.fillStyle = colours.theta;
    pen.beginPath();
    pen.ellipse(0.8 * R * Math.sin(turn), 0.4 * R, 0.1 * R * Math.cos(turn), 0.1 * R, 0, 0, 2 * Math.PI);
    pen.fill();
  }
  pen.restore();
}

class Flat {
  /** @param {TopModel} model @param {{ root: HTMLElement, picture: HTMLElement, life: AbortSignal }} frame */
  constructor(model, { root, picture, life }) {
    this.model = model;
    this.picture = picture;
    this.canvas = part("canvas", { style: "cursor: default", role: "img", "aria-label": model.label || model.texts.label });
    picture.prepend(this.canvas);
    this.pose = emptyPose();
    this.pictures = 0;
    this.reach = LEAST_REACH;
    this.verdict = model.texts.no_motion;
    this.draw = coalesce(() => this.tick(), life);
    this.place = new Place({
      model, picture, life, report: this.report,
      changed: () => this.draw(),
      inView: () => picture.clientWidth > 0,
      photo: (wide) => this.photo(wide),
    });
    this.player = this.place.player;
    this.bar = model.bare ? null : new Bar(root, picture, model, this.player, null);
    this.begin(life);
  }

  tick() {
    const { place, canvas, model, picture: { clientWidth: width, clientHeight: height } } = this;
    if (place.moves) place.advance(performance.now());
    if (width && height) {
      canvas.width = width * devicePixelRatio;
      canvas.height = height * devicePixelRatio;
      this.paint(canvas, width, height, devicePixelRatio);
      this.pictures += 1;
    }
    if (this.player.frames.count) this.bar?.update(model.seconds);
    place.say(this.verdict);
    if (place.moves) this.draw();
  }

  photo(wide) {
    const still = document.createElement("canvas"), { clientWidth: width, clientHeight: height } = this.picture;
    const scale = wide / (width || WIDTH);
    still.width = wide;
    still.height = Math.round(scale * (height || WIDTH));
    this.paint(still, still.width / scale, still.height / scale, scale);
    return still;
  }

  paint(on, width, height, scale) {
    const pen = penOf(on), { player, pose, model } = this, look = /** @type {Record<string, any>} */ (this.look);
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.fillStyle = look.sky;
    pen.fillRect(0, 0, width, height);
    const R = height / (this.reach + 1.3 + BELOW), table = height - BELOW * R;
    pen.fillStyle = look.table;
    pen.fillRect(0, table, width, height - table);
    this.verdict = model.texts.no_motion;
    if (!player.frames.count) return;
    player.frames.read(player.place, pose);
    const { x, y, z, w } = pose.quaternion;
    const tilt = pose.theta, psi = Math.atan2(z, w) - Math.atan2(y, x);
    centreOf(pose, model.a, centre);
    drawBody(pen, float32(model.profile), { x: width / 2, y: table - centre.z * R, R, tilt, turn: psi, edge: look.edge });
    pen.fillStyle = look.ink;
    pen.font = "600 14px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.fillText(`θ = ${local(((180 * tilt) / Math.PI).toFixed(1))}°`, width / 2, 24);
    this.verdict = wordOf(pose.regime, model.texts.regimes);
  }

  newProfile() {
    const profile = float32(this.model.profile);
    this.reach = LEAST_REACH;
    for (let i = 0; i + 1 < profile.length; i += 2) this.reach = Math.max(this.reach, Math.hypot(profile[i], profile[i + 1]));
    this.draw();
  }

  /** @param {AbortSignal} life */
  begin(life) {
    const { model, place, draw } = this;
    model.on("frames", () => {
      place.take();
      draw();
    });
    model.on("profile", () => this.newProfile());
    new ResizeObserver(draw).observe(this.picture);
    this.newProfile();
    place.take();
    place.begin();
    if (!model.clock) report("flat", this.report, life);
    followScene((now) => {
      this.look = now;
      draw();
    }, life);
  }

  report = () => {
    const { pictures, verdict, player: { t, index, playing, frames: { count } } } = this;
    return { pictures, t, index, count, playing, verdict };
  };
}

/** @param {TopModel} model @param {{ root: HTMLElement, picture: HTMLElement, life: AbortSignal }} frame */
export function renderFlat(model, frame) {
  const words = /** @type {HTMLElement} */ (frame.picture.querySelector(".note"));
  words.textContent = model.texts.flat;
  Object.assign(words.style, { position: "static", marginTop: "6px" });
  new Flat(model, frame);
  frame.root.append(words);
}
