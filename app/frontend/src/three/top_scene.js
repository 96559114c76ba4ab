// The objects of a top on its table, and their positions at a moment.
import * as THREE from "three";
import { Arrow } from "./arrow.js";
import { Body } from "./body.js";
import { colours } from "../colours.js";
import { niceAbove } from "../data.js";
import { centreOf, emptyPose } from "../motion/frames.js";
import { Labels } from "./labels.js";
import { WideLine } from "./lines.js";
import { Ribbon, Thread } from "./ribbon.js";
import { followScene } from "./scene.js";
import { TraceLine } from "./trace.js";
import { blobMaterial, dressTable, makeTable, TABLE } from "./table.js";
/** @import { Stage } from "./stage.js" */
/** @import { Frames } from "../motion/frames.js" */

const SHADE = 4.5; // half the side of the square that can receive shadows
const USUAL = 2; // R: the scene has room for a body of this reach, and is enlarged for a larger one
const NEAR = 9, FAR = TABLE - 2; // R: distances between which the table fades, for a usual body
const ABOVE_TABLE = 0.006; // lines lie this far above the table, so that the table does not hide them
const LONGEST = { force: 1.8, omega: 2.2, momentum: 1.7 }; // R: the longest arrow of a motion has at most this length

function makeSun() {
  const sun = Object.assign(new THREE.DirectionalLight(0xfff4e2, 2.1), { castShadow: true });
  sun.shadow.mapSize.set(1024, 1024);
  Object.assign(sun.shadow, { radius: 3, bias: -0.002 });
  return sun;
}

// The friction cone: height 1 and radius 1, standing on its tip; scaled to the cone of the moment.
function frictionCone() {
  const see = { color: colours.friction, transparent: true, depthTest: false, depthWrite: false };
  const side = new THREE.Mesh(new THREE.ConeGeometry(1, 1, 48, 1, true).rotateX(-Math.PI / 2).translate(0, 0, 0.5),
    new THREE.MeshBasicMaterial({ ...see, opacity: 0.16, side: THREE.DoubleSide }));
  const rim = new WideLine({ ...see, linewidth: 2, opacity: 0.8 });
  rim.setPath(65, (i, put) => put(Math.cos((i * Math.PI) / 32), Math.sin((i * Math.PI) / 32), 1));
  for (const part of [side, rim]) part.renderOrder = 2;
  return new THREE.Group().add(side, rim);
}

export class TopScene {
  /** @param {Stage} stage @param {AbortSignal} life */
  constructor(stage, life) {
    const { scene, renderer } = stage;
    this.stage = stage;
    this.moment = emptyPose(); // the pose at the player's time
    this.stands = new THREE.Vector3(); // the centre of the sphere
    this.scales = {};
    this.size = this.squares = 1;

    // The table, the light, and the shadow below the top.
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFShadowMap;
    this.background = scene.background = new THREE.Color();
    this.fog = scene.fog = new THREE.Fog(0, NEAR, FAR);
    this.table = makeTable();
    this.shade = new THREE.Mesh(new THREE.PlaneGeometry(2 * SHADE, 2 * SHADE), new THREE.ShadowMaterial({ opacity: 0.34, depthWrite: false }));
    this.shade.receiveShadow = true;
    this.sun = makeSun();
    this.underneath = new THREE.Mesh(new THREE.PlaneGeometry(1.5, 1.5), blobMaterial());
    this.underneath.renderOrder = -1;
    this.body = new Body();
    scene.add(this.table, this.shade, new THREE.HemisphereLight(0xffffff, 0xb9a88f, 1.7), this.sun, this.sun.target);
    scene.add(this.underneath, this.body);

    // Paths: the whole one faintly, the part that has passed boldly.
    this.track = {
      whole: new Ribbon(0.028, { color: colours.theta, opacity: 0.25 }),
      passed: new Ribbon(0.045, { color: colours.theta, opacity: 0.95 }),
    };
    this.comPath = { whole: new Thread({ opacity: 0.3 }), passed: new Thread({ opacity: 0.9 }) };
    this.trace = new TraceLine();
    this.body.add(this.trace);
    scene.add(...Object.values(this.track), ...Object.values(this.comPath));

    // Arrows, the friction cone, and the markers of C and G.
    this.arrows = {
      force: new Arrow(colours.normal, { radius: 0.045, through: 0.85 }),
      omega: new Arrow(colours.omega),
      momentum: new Arrow(colours.momentum, { radius: 0.055 }),
    };
    this.pointedAt = new Arrow(0, { radius: 0.05, through: 0.85 }); // what a text points at, shown alone
    this.cone = frictionCone();
    this.centre = new THREE.Mesh(new THREE.SphereGeometry(0.045, 16, 12), new THREE.MeshBasicMaterial({ depthTest: false, transparent: true }));
    this.centre.renderOrder = 4;
    scene.add(...Object.values(this.arrows), this.pointedAt, this.cone, this.centre);
    this.labels = new Labels(stage);
    const vector = (letter) => this.labels.add(letter, "vector");
    this.tips = { force: vector("F"), omega: vector("ω"), momentum: vector("L"), centre: vector("G") };
    this.pointedTip = vector("");
    followScene((look) => this.dress(look), life);
    this.fitTo(1);
  }

  dress(look) {
    for (const colour of [this.background, this.fog.color]) colour.set(look.sky).convertLinearToSRGB();
    dressTable(this.table, look);
    for (const { material } of [this.comPath.whole, this.comPath.passed, this.centre]) material.color.set(look.ink);
    this.shade.material.color.set(look.shade);
    this.pointedAt.colour = look.ink;
    for (const name of ["force", "omega", "momentum"]) this.arrows[name].colour = look[name];
    for (const name of Object.keys(LONGEST)) this.tips[name].element.style.color = look[name];
    this.stage.invalidate();
  }

  // Adjusts table, fading, light and shadow to a body of a given reach, in R.
  /** @param {number} reach */
  fitTo(reach) {
    const { sun, fog } = this, size = (this.size = Math.max(1, reach / USUAL)), { camera } = sun.shadow;
    Object.assign(fog, { near: NEAR * size, far: FAR * size });
    this.squares = Math.ceil(size - 1e-9); // side of the grid's squares, in R: for a large body, smaller ones would be invisible
    this.table.scale.set(this.squares, this.squares, 1);
    this.shade.scale.setScalar(size);
    this.underneath.scale.setScalar(Math.min(size, 2));
    Object.assign(camera, { left: -3.2 * size, right: 3.2 * size, top: 3.2 * size, bottom: -3.2 * size, near: 4 * size, far: 16 * size });
    camera.updateProjectionMatrix();
  }

  // A new motion: sets its paths, and the scale of its arrows.
  /** @param {Frames} frames */
  setFrames(frames) {
    for (const name of Object.keys(LONGEST)) this.scales[name] = 1 / niceAbove(frames.scales[name] / LONGEST[name]);
    this.trace.forget();
    for (const line of Object.values(this.track)) line.setPath(frames.count, (i) => frames.contact(i), ABOVE_TABLE);
    for (const line of Object.values(this.comPath)) line.setPath(frames.count, (i, put) => frames.com(i, put));
  }

  // Shows the picture at a position among the frames.
  /** @param {Frames} frames @param {number} at @param {TopModel} model @param {Pointed | null} highlight */
  pose(frames, at, model, highlight) {
    const { moment, centre, tips } = this, some = frames.count > 0;
    this.body.visible = this.underneath.visible = some;
    centre.visible = some && model.show_com_path;
    if (some) {
      frames.read(at, moment);
      this.put(model.a);
    }
    this.point("force", moment.contact, moment.force, some && model.show_force);
    this.point("omega", moment.com, moment.omega, some && model.show_omega);
    this.point("momentum", moment.com, moment.momentum, some && model.show_momentum);
    this.showPointed(some ? highlight : null);
    tips.centre.visible = centre.visible;
    tips.centre.at.copy(moment.com);
    tips.centre.shift = [-14, 6];
    this.showCone(some && model.show_cone, model.mu_s);
    const passed = Math.ceil(at);
    this.showPath(this.track, model.show_track, passed, frames.count);
    this.trace.showTo(frames, model.a, at, model.show_trace);
    this.showPath(this.comPath, model.show_com_path, passed, frames.count);
  }

  // The body, what moves along with it, and the light.
  /** @param {number | null} a distance between O and G, if the centre O of the sphere may not be above the contact */
  put(a) {
    const { moment, stands, body } = this;
    stands.set(moment.contact.x, moment.contact.y, 1);
    body.quaternion.copy(moment.quaternion);
    centreOf(moment, a, body.position);
    this.underneath.position.set(stands.x, stands.y, ABOVE_TABLE / 2);
    const { size, squares } = this, lattice = 5 * squares; // the grid repeats every 5 squares
    this.shade.position.set(stands.x + 1.2 * size, stands.y + 1.3 * size, ABOVE_TABLE / 3);
    this.centre.position.copy(moment.com);
    this.sun.target.position.copy(stands);
    this.sun.position.set(stands.x - 3.2 * size, stands.y - 3.4 * size, 8.2 * size);
    this.table.position.set(Math.round(stands.x / lattice) * lattice, Math.round(stands.y / lattice) * lattice, 0);
  }

  point(name, from, vector, visible) {
    const arrow = this.arrows[name], tip = this.tips[name], scale = this.scales[name] ?? 1;
    arrow.point(from, vector.x * scale, vector.y * scale, vector.z * scale, tip.at);
    arrow.visible = tip.visible = visible && arrow.drawable;
    tip.shift = name === "omega" ? [16, -4] : [-15, -6];
  }

  // A vector along the turning axes 1', y, z, from "com" or "contact". Its length is limited, its direction is exact.
  /** @param {Pointed | null} highlight */
  showPointed(highlight) {
    const { moment, pointedAt, pointedTip } = this;
    const axis = new THREE.Vector3(0, 0, 1).applyQuaternion(moment.quaternion);
    const first = new THREE.Vector3(-axis.y, axis.x, 0).normalize(); // 1' = z x 3
    const [x, y, z] = highlight?.vector ?? [0, 0, 0];
    const along = new THREE.Vector3(first.x * x - first.y * y, first.y * x + first.x * y, z);
    along.clampLength(0.4, 1.8);
    pointedAt.point(highlight?.start === "contact" ? moment.contact : moment.com, along.x, along.y, along.z, pointedTip.at);
    pointedAt.visible = pointedTip.visible = Boolean(highlight && pointedAt.drawable);
    if (!pointedAt.visible) return;
    pointedTip.shift = [14, -6];
    for (const name of Object.keys(this.arrows)) this.arrows[name].visible = this.tips[name].visible = false;
  }

  // As high as the arrow: then its tip is inside the rim as long as the top can roll.
  showCone(visible, mu_s) {
    const { moment, cone } = this, height = moment.force.z * this.scales.force;
    cone.visible = visible && height > 1e-3 && mu_s > 0;
    cone.position.copy(moment.contact);
    cone.scale.set(height * mu_s, height * mu_s, height);
  }

  showPath(line, visible, passed, count) {
    line.whole.points = visible ? count : 0;
    line.passed.points = visible ? passed + 1 : 0;
  }
}
