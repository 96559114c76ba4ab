// Fig. 5: f1^2 theta_dot^2 over the (K_J, theta) plane, one row for each tieline. Redrawn only when something changes.
import * as THREE from "three";
import { Axes, Scale } from "./axes.js";
import { colours } from "../colours.js";
import { coalesce, float32, local } from "../data.js";
import { hideReadout, showReadout } from "../figures/readout.js";
import { atEnd, lifeOf, report } from "../life.js";
import { Labels } from "./labels.js";
import { wordOf } from "../regimes.js";
import { followScene } from "./scene.js";
import { tryStage } from "./stage.js";
import { frameIn } from "../style.js";
import { part } from "../parts.js";
import { SurfaceHand } from "./surface_hand.js";
import { dot, SurfaceLines } from "./surface_lines.js";
import { Grid, SurfaceMesh } from "./surface_mesh.js";
/** @import { Stage } from "./stage.js" */

const DATA = ["K_J", "theta", "heights", "energy", "verge", "steady", "P", "theta_max", "limit"];
const QUANTITY = "<i>f</i><sub>1</sub><sup>2</sup> <i>θ̇</i><sup>2</sup>";
const NAMES = { x: "<i>θ</i> (rad)", y: "<i>K</i><sub>J</sub>", z: QUANTITY };
// why: the word of model.texts for what cannot be
const LIMITS = {
  "lift-off": { colour: colours.normal, text: "<i>F</i><sub>z</sub> = 0", why: "above_lift" },
  slip: {
    colour: colours.friction, text: "<i>F</i><sub>h</sub> = <i>μ</i><sub>s</sub><i>F</i><sub>z</sub>", why: "above_slip",
  },
};
const WIDEST = 1.55; // the initial distance suits this aspect ratio and all wider ones
const CENTRE = new THREE.Vector3(0.05, 0, 0.4); // the point that the camera looks at

function addLight(scene) {
  const lamp = new THREE.DirectionalLight(0xffffff, 1.3);
  lamp.position.set(-2, -3, 5);
  scene.add(new THREE.HemisphereLight(0xffffff, 0xcfd4dc, 2.5), lamp);
}

export class Surface {
  /** @param {SurfaceModel} model @param {Stage} stage @param {HTMLElement} picture @param {AbortSignal} life */
  constructor(model, stage, picture, life) {
    const { scene, renderer } = stage;
    this.model = model;
    this.stage = stage;
    this.picture = picture;
    // theta, K_J and the height along the edges of the box
    this.scales = { x: new Scale(-1.2, 1.2), y: new Scale(-1, 1), z: new Scale(0, 1.15) };
    this.background = scene.background = new THREE.Color();
    addLight(scene);
    this.labels = new Labels(stage);
    this.axes = new Axes(stage, this.labels, this.scales, NAMES);
    // Tielines may extend beyond theta_max, as in the paper's own figure: there they are cut off.
    renderer.localClippingEnabled = true;
    const clippingPlanes = [new THREE.Plane(new THREE.Vector3(-1, 0, 0), this.scales.x.to + 1e-4)];
    this.mesh = new SurfaceMesh(this.scales, clippingPlanes);
    this.lines = new SurfaceLines(scene, this.labels, this.scales, clippingPlanes);
    this.marker = dot(colours.theta, 0.024);
    scene.add(this.mesh.object, this.marker);
    /** @type {HTMLElement | null} */
    this.readout = null; // while it shows values
    this.key = part("div", { class: "key" });
    picture.after(this.key); // below the picture: on it, it would hide the numbers of an axis
    this.grid = new Grid({ K_J: float32(), theta: float32(), height: float32(), energy: float32() });
    this.selected = { K_J: NaN, inner: 0, outer: 0 }; // the selected motion
    this.wrong = ""; // why the selected motion is impossible
    this.drawing = this.shown = NaN; // its K_J in the picture being drawn, and in the one on the screen
    this.hand = new SurfaceHand(this, life);
    followScene((look) => this.dress(look), life);
    stage.tick = () => {
      this.drawing = this.selected.K_J;
      return false;
    };
    stage.shown = () => (this.shown = this.drawing);
    stage.fit = (aspect) => this.fit(aspect);
    stage.beforeDraw = () => {
      this.axes.place();
      this.labels.place();
    };
  }

  dress(look) {
    this.background.set(look.ground).convertLinearToSRGB();
    this.lines.dress(look);
    this.axes.dress(look);
    this.stage.invalidate();
  }

  update() {
    const { model, scales: { x, y, z } } = this;
    const [K_J, theta, height, energy] = [model.K_J, model.theta, model.heights, model.energy].map(float32);
    this.grid = new Grid({ K_J, theta, height, energy });
    let most = 0;
    for (const value of height) if (value > most) most = value;
    const ends = K_J.length ? y.set(K_J.reduce((a, b) => Math.min(a, b)), K_J.reduce((a, b) => Math.max(a, b))) : false;
    if ([ends, x.set(0, model.theta_max), z.setAbove(most)].some(Boolean)) this.axes.place(true);
    this.mesh.show(this.grid);
    const limit = LIMITS[model.limit], { texts } = model;
    this.lines.show(this.grid, model, limit.colour);
    this.key.innerHTML =
      `<span style="--swatch: ${limit.colour}">${limit.text}</span>` +
      `<span style="--swatch: var(--scene-ink)">${texts.steady}</span><span style="--swatch: ${colours.theta}">${texts.motion}</span>`;
    this.showSelected();
    this.hand.refresh();
    this.stage.invalidate();
  }

  // Dragging changes the selected motion only.
  updateSelected() {
    this.showSelected();
    this.stage.invalidate();
  }

  showSelected() {
    const [K_J, inner, outer, worst = 0] = float32(this.model.selected), { texts } = this.model;
    this.selected = { K_J, inner, outer };
    this.wrong = wordOf(worst, texts.regimes) ?? "";
    this.hand.say();
    this.lines.showSelected(this.selected, float32(this.model.selected_curve), worst);
  }

  // Shows values. i: index of a point of the mesh
  /** @param {number} i @param {PointerEvent} event */
  readValue(i, event) {
    const { grid: { theta, K_J, height, energy, columns }, marker } = this, row = Math.floor(i / columns);
    this.readAt(event,
      `<i>θ</i> = ${local(theta[i].toFixed(4))} rad = ${local(((theta[i] * 180) / Math.PI).toFixed(2))}°<br>` +
      `<i>K</i><sub>J</sub> = ${local(K_J[row].toFixed(4))}<br>${QUANTITY} = ${local(height[i].toFixed(4))}<br><i>E</i> = ${local(energy[row].toFixed(4))}`);
    marker.visible = true;
    marker.position.fromBufferAttribute(this.mesh.object.geometry.attributes.position, i);
    this.stage.invalidate();
  }

  /** @param {[theta: number, K_J: number]} place @param {PointerEvent} event */
  readWhyNot([theta, K_J], event) {
    const { texts, limit } = this.model;
    this.marker.visible = false;
    this.readAt(event, `<i>θ</i> = ${local(theta.toFixed(3))} rad, <i>K</i><sub>J</sub> = ${local(K_J.toFixed(3))}<br>${texts[LIMITS[limit].why]}`);
    this.stage.invalidate();
  }

  /** @param {PointerEvent} event */
  readWrong(event) {
    if (this.wrong) this.readAt(event, this.wrong);
    else this.hideReadout();
  }

  hideReadout() {
    hideReadout(this);
    this.readout = null;
  }

  readNothing() {
    if (!this.readout) return;
    this.hideReadout();
    this.marker.visible = false;
    this.stage.invalidate();
  }

  /** @param {PointerEvent} event @param {string} html */
  readAt({ clientX, clientY }, html) {
    this.readout = showReadout(this, html, [clientX, clientY], []);
  }

  /** @param {number} now of the window */
  fit(now) {
    const { camera, controls } = this.stage;
    if (this.aspect === undefined) {
      camera.position.set(2.2, -4.5, 2.7);
      controls.target.copy(CENTRE);
      controls.minDistance = 2;
      controls.maxDistance = 16;
      controls.maxPolarAngle = Math.PI / 2;
      this.aspect = WIDEST;
    }
    const was = Math.min(WIDEST, this.aspect), is = Math.min(WIDEST, now);
    if (was !== is) camera.position.sub(CENTRE).multiplyScalar(was / is).add(CENTRE);
    this.aspect = now;
    controls.update();
    this.axes.place();
  }

  /** @param {AbortSignal} life */
  begin(life) {
    const { model } = this;
    const onData = coalesce(() => this.update(), life); // a new scene sets many parameters, but is drawn once
    const onSelected = coalesce(() => this.updateSelected(), life);
    for (const name of DATA) model.on(name, onData);
    for (const name of ["selected", "selected_curve"]) model.on(name, onSelected);
    this.update();
    report("surface3d", () => this.report(), life);
    atEnd(life, () => hideReadout(this));
  }

  // grips: where on the page the ends of the selected motion can be grabbed
  report() {
    const { grid: { rows, columns, ...grid }, stage: { pictures }, shown: selected, selected: { inner, outer }, readout } = this;
    const [K_J, theta, height] = [grid.K_J, grid.theta, grid.height].map((values) => Array.from(values));
    return { rows, columns, K_J, theta, height, pictures, selected, grips: [inner, outer].map((end) => this.hand.onPage(end)), readout: readout?.textContent ?? "" };
  }
}

/** @param {Rendering<SurfaceModel>} rendering */
export function renderSurface3D(rendering) {
  const { model, el } = rendering, { texts } = model, life = lifeOf(rendering), { picture } = frameIn(el);
  picture.dataset.picture = "surface";
  const stage = tryStage(picture, { label: texts.label, texts, fov: 26, life });
  if (stage) new Surface(model, stage, picture, life).begin(life);
}
