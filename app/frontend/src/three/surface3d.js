// Fig. 5: f1^2 theta_dot^2 over the (K_J, theta) plane, one row a tieline. Drawn only when something changed.
import * as THREE from "three";
import { Axes, Scale } from "./axes.js";
import { colours } from "../colours.js";
import { coalesce, float32 } from "../data.js";
import { Labels } from "./labels.js";
import { colourOf, wordOf } from "../regimes.js";
import { WideLine } from "./lines.js";
import { followLook } from "./scene.js";
import { tryStage } from "./stage.js";
import { frameIn } from "../style.js";
/** @import { Stage } from "./stage.js" */

const INK = 0x1d2733; // on the surface itself, which is pale on every page
const CURVES = 26; // about so many of the rows have their curve and their tieline drawn
const CLICK_PX = 4; // a press that moves less than this is a click, not a turn

// Pale to dark in even steps of OKLCH's lightness, from yellow to brown: no hue of a line is among them.
const ramp = ["#f8f2dd", "#eed8a8", "#e5bb76", "#da9f4a", "#cc8325", "#b8690f", "#9f5414", "#81421e", "#623422"].map((hex) => new THREE.Color(hex));

const data = ["K_J", "theta", "heights", "energy", "verge", "steady", "P", "theta_max", "limit"];
const QUANTITY = "<i>f</i><sub>1</sub><sup>2</sup> <i>θ̇</i><sup>2</sup>";
// why: the word of model.texts for what cannot be
const limits = {
  "lift-off": { colour: colours.normal, text: "<i>F</i><sub>z</sub> = 0", why: "above_lift" },
  slip: {
    colour: colours.friction, text: "<i>F</i><sub>h</sub> = <i>μ</i><sub>s</sub><i>F</i><sub>z</sub>", why: "above_slip",
  },
};
const GRIP_PX = 14;

/** @param {Rendering<SurfaceModel>} rendering */
export function renderSurface3D({ model, el, view }) {
  view.tippe?.dispose(); // Panel may build a view anew without saying "remove"
  const { picture } = frameIn(el), { texts } = model;
  picture.dataset.picture = "surface";
  const stage = /** @type {Stage} */ (
    tryStage(picture, { label: texts.label, texts, fov: 26, fit, tick, shown: () => (shown = drawing) })
  );
  if (!stage) return;
  const { scene, camera, controls, renderer } = stage;
  const background = (scene.background = new THREE.Color());
  scene.add(new THREE.HemisphereLight(0xffffff, 0xcfd4dc, 2.5));
  const lamp = new THREE.DirectionalLight(0xffffff, 1.3);
  lamp.position.set(-2, -3, 5);
  scene.add(lamp);

  // theta, K_J and the height on the sides of the box
  const x = new Scale(-1.2, 1.2), y = new Scale(-1, 1), z = new Scale(0, 1.15);
  const labels = new Labels(stage);
  const axes = new Axes(stage, labels, { x, y, z }, {
    x: "<i>θ</i> (rad)",
    y: "<i>K</i><sub>J</sub>",
    z: QUANTITY,
  });

  // Tielines may go past theta_max, as in the paper's own figure: there they are cut off.
  renderer.localClippingEnabled = true;
  const clippingPlanes = [new THREE.Plane(new THREE.Vector3(-1, 0, 0), x.to + 1e-4)];
  const mesh = new THREE.Mesh(
    new THREE.BufferGeometry(),
    new THREE.MeshLambertMaterial({
      vertexColors: true, side: THREE.DoubleSide, clippingPlanes,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }),
  );
  mesh.frustumCulled = false;
  const wide = (color, linewidth) => new WideLine({ color, linewidth, clippingPlanes });
  // What lies on the floor under the surface shows through it, paler.
  const through = (color, linewidth, opacity = 0.35) =>
    new WideLine({
      color, linewidth, clippingPlanes, transparent: true, opacity, depthFunc: THREE.GreaterDepth, depthWrite: false,
    });
  const curves = new WideLine({ color: INK, linewidth: 1, transparent: true, opacity: 0.6, clippingPlanes });
  const floor = {
    tielines: [wide(0, 1.2), through(INK, 1.2)],
    verge: [wide(colours.normal, 2.6), through(colours.normal, 2.6)],
    steady: [wide(0, 2.2), through(INK, 2.2)],
    selected: [wide(colours.theta, 4.5), through(colours.theta, 4.5, 0.6)],
  };
  const selectedCurves = [wide(colours.theta, 4.5), through(colours.theta, 4.5, 0.6)];
  const pairs = [...Object.values(floor), selectedCurves];
  for (const [, hidden] of pairs) hidden.renderOrder = 1;
  const dot = (colour, radius) => {
    const sphere = new THREE.Mesh(new THREE.SphereGeometry(radius, 16, 12), new THREE.MeshBasicMaterial({ color: colour }));
    sphere.visible = false;
    scene.add(sphere);
    return sphere;
  };
  const pole = dot(0, 0.028);
  const poleLabel = labels.add("<i>P</i>", "point");
  poleLabel.shift = [12, -12];
  const marker = dot(colours.theta, 0.024);
  scene.add(mesh, curves, ...pairs.flat());

  const unfollow = followLook((look) => {
    background.set(look.ground);
    floor.tielines[0].material.color.set(look.lines);
    for (const { material } of [floor.steady[0], pole]) material.color.set(look.ink);
    axes.dress(look);
    stage.invalidate();
  });

  const readout = document.createElement("div");
  readout.className = "readout";
  readout.hidden = true;
  const key = document.createElement("div");
  key.className = "key";
  picture.append(readout, key);

  let rows = 0, columns = 0, K_J, theta, height, energy;
  let ends = [0, 0], why; // of the motion on display
  let selected, drawing, shown; // K_J of the motion on display: as sent, in the picture begun, and on the screen

  function tick() {
    drawing = selected;
    return false;
  }

  // What a hand moves is one motion among the many.
  function updateSelected() {
    buildSelected();
    stage.invalidate();
  }

  function update() {
    [K_J, theta, height, energy] = [model.K_J, model.theta, model.heights, model.energy].map(float32);
    rows = K_J.length;
    columns = rows ? Math.floor(theta.length / rows) : 0;
    let most = 0, low = Infinity, high = -Infinity;
    for (let i = 0; i < rows; i++) {
      low = Math.min(low, K_J[i]);
      high = Math.max(high, K_J[i]);
    }
    for (const value of height) if (value > most) most = value;
    const moved = [rows ? y.set(low, high) : false, x.set(0, model.theta_max), z.setAbove(most)].some(Boolean);
    if (moved) axes.place(true);
    buildSurface();
    buildLines();
    buildSelected();
    if (!readout.hidden && lastMove && !gripped) hover(); // new numbers under a resting mouse
    stage.invalidate();
  }

  const real = (i) => Number.isFinite(height[i * columns]) && Number.isFinite(theta[i * columns]);

  function buildSurface() {
    let { geometry } = mesh;
    const count = rows * columns;
    if (geometry.attributes.position?.count !== count) {
      geometry.dispose();
      geometry = mesh.geometry = new THREE.BufferGeometry();
      for (const name of ["position", "normal", "color"]) {
        geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * count), 3));
      }
      geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(6 * Math.max(rows - 1, 0) * Math.max(columns - 1, 0)), 1));
    }
    const { position, color } = geometry.attributes;
    const shade = new THREE.Color();
    for (let i = 0, at = 0; i < rows; i++) {
      const there = real(i), b = y.at(K_J[i]);
      for (let j = 0; j < columns; j++, at++) {
        position.setXYZ(at, there ? x.at(theta[at]) : 0, b, there ? z.at(height[at]) : 0);
        // Over the root of the height, so that the low part, most of the surface, has shades too.
        const place = Math.min(Math.sqrt(Math.max(there ? height[at] / z.high : 0, 0)) * (ramp.length - 1), ramp.length - 1.001), k = Math.floor(place);
        shade.lerpColors(ramp[k], ramp[k + 1], place - k);
        color.setXYZ(at, shade.r, shade.g, shade.b);
      }
    }
    const triangles = /** @type {THREE.BufferAttribute} */ (geometry.index), index = /** @type {Uint32Array} */ (triangles.array);
    let used = 0;
    for (let i = 0; i + 1 < rows; i++) {
      if (!real(i) || !real(i + 1)) continue; // no motion there: a gap
      for (let j = 0; j + 1 < columns; j++) {
        const a = i * columns + j, b = a + columns;
        index.set([a, a + 1, b, b, a + 1, b + 1], used);
        used += 6;
      }
    }
    index.fill(0, used); // triangles without area
    for (const attribute of [triangles, position, color]) attribute.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere(); // the ray under the pointer asks for it
  }

  function buildLines() {
    const every = Math.max(1, Math.round(rows / CURVES));
    const drawn = [];
    for (let i = 0; i < rows; i++) if (real(i) && (i % every === 0 || i === rows - 1)) drawn.push(i);
    const pieces = Math.max(columns - 1, 0);
    curves.setSegments(drawn.length * pieces, (s, put) => {
      const i = drawn[Math.floor(s / pieces)], at = i * columns + (s % pieces);
      for (const a of [at, at + 1]) put(x.at(theta[a]), y.at(K_J[i]), z.at(height[a]));
    });
    for (const line of floor.tielines) {
      line.setSegments(drawn.length, (s, put) => {
        const i = drawn[s];
        for (const a of [i * columns, (i + 1) * columns - 1]) put(x.at(theta[a]), y.at(K_J[i]), 0);
      });
    }
    const verge = float32(model.verge), steady = float32(model.steady);
    for (const [lines, points] of /** @type {[WideLine[], Float32Array][]} */ ([[floor.verge, verge], [floor.steady, steady]])) {
      // Where one of a pair's ends is missing the line has a gap.
      const joined = [];
      for (let i = 0; i + 3 < points.length; i += 2) if (points.subarray(i, i + 4).every(Number.isFinite)) joined.push(i);
      for (const line of lines) {
        line.setSegments(joined.length, (s, put) => {
          const at = joined[s];
          for (const a of [at, at + 2]) put(x.at(points[a]), y.at(points[a + 1]), 0.002);
        });
      }
    }
    const limit = limits[model.limit];
    for (const line of floor.verge) line.material.color.set(limit.colour);
    key.innerHTML =
      `<span style="--swatch: ${limit.colour}">${limit.text}</span>` +
      `<span style="--swatch: var(--scene-ink, #1d2733)">${texts.steady}</span><span style="--swatch: ${colours.theta}">${texts.motion}</span>`;

    const [poleTheta, poleK, poleHeight] = float32(model.P);
    pole.visible = poleLabel.visible = Number.isFinite(poleHeight) && poleK >= y.low && poleK <= y.high;
    if (pole.visible) {
      pole.position.set(x.at(poleTheta), y.at(poleK), z.at(poleHeight));
      poleLabel.at.copy(pole.position);
    }
  }

  function buildSelected() {
    const [chosen, inner, outer, worst = 0] = float32(model.selected), curve = float32(model.selected_curve);
    selected = chosen;
    ends = [inner, outer];
    why = wordOf(worst, texts.worst);
    for (const line of [...floor.selected, ...selectedCurves]) line.material.color.set(colourOf(worst));
    if (gripped) say();
    const inBox = Number.isFinite(chosen) && chosen >= y.low && chosen <= y.high;
    for (const line of floor.selected) {
      line.setSegments(inBox ? 1 : 0, (s, put) => {
        for (const end of [inner, outer]) put(x.at(end), y.at(chosen), 0.004);
      });
    }
    for (const line of selectedCurves) {
      line.setPath(inBox ? curve.length >> 1 : 0, (i, put) => put(x.at(curve[2 * i]), y.at(chosen), z.at(curve[2 * i + 1])));
    }
  }

  // Reading values off: the nearest point of the mesh under the pointer
  const ray = new THREE.Raycaster(), pointer = new THREE.Vector2(), corner = new THREE.Vector3();
  function under(event) {
    const box = picture.getBoundingClientRect();
    pointer.set(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    ray.setFromCamera(pointer, camera);
    const hit = rows > 1 && ray.intersectObject(mesh, false).find(({ point }) => point.x <= x.to + 1e-6);
    if (!hit) return null;
    const { position } = mesh.geometry.attributes;
    const distance = (i) => corner.fromBufferAttribute(position, i).distanceToSquared(hit.point);
    const { a, b, c } = /** @type {THREE.Face} */ (hit.face);
    return [a, b, c].reduce((best, i) => (distance(i) < distance(best) ? i : best));
  }

  let lastMove;
  const hover = coalesce(() => {
    const i = under(lastMove);
    if (i === null) return sayWhyNot();
    const row = Math.floor(i / columns);
    const radians = theta[i];
    readout.innerHTML =
      `<i>θ</i> = ${radians.toFixed(4)} rad = ${((radians * 180) / Math.PI).toFixed(2)}°<br>` +
      `<i>K</i><sub>J</sub> = ${K_J[row].toFixed(4)}<br>${QUANTITY} = ${height[i].toFixed(4)}<br><i>E</i> = ${energy[row].toFixed(4)}`;
    placeReadout();
    marker.visible = true;
    marker.position.fromBufferAttribute(mesh.geometry.attributes.position, i);
    stage.invalidate();
  });
  function placeReadout() {
    readout.hidden = false;
    const box = picture.getBoundingClientRect();
    const left = Math.min(lastMove.clientX - box.left + 16, box.width - readout.offsetWidth - 8);
    const top = Math.max(lastMove.clientY - box.top - readout.offsetHeight - 12, 8);
    readout.style.transform = `translate(${left}px, ${top}px)`;
  }

  // The floor under the pointer: [theta, K_J], or null outside the box.
  const ground = new THREE.Plane(new THREE.Vector3(0, 0, 1), 0), foot = new THREE.Vector3();
  /** @param {PointerEvent} event @returns {[theta: number, K_J: number] | null} */
  function onFloor(event, anywhere = false) {
    const box = picture.getBoundingClientRect();
    pointer.set(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    ray.setFromCamera(pointer, camera);
    if (!ray.ray.intersectPlane(ground, foot)) return null;
    const inside = foot.x >= x.from && foot.x <= x.to && foot.y >= y.from && foot.y <= y.to;
    return anywhere || inside ? [x.value(foot.x), y.value(foot.y)] : null;
  }

  // Beyond the ends of the tielines the floor says why there is no surface over it.
  function sayWhyNot() {
    const place = rows > 1 && onFloor(lastMove);
    if (!place) return leave();
    marker.visible = false;
    readout.innerHTML =
      `<i>θ</i> = ${place[0].toFixed(3)} rad, <i>K</i><sub>J</sub> = ${place[1].toFixed(3)}<br>${texts[limits[model.limit].why]}`;
    placeReadout();
    stage.invalidate();
  }

  // The tieline on display can be taken hold of on the floor: an end of it, or all of it.
  /** @type {"end" | "line" | null} */
  let gripped = null;
  function gripUnder(event) {
    if (!Number.isFinite(selected)) return null;
    const box = picture.getBoundingClientRect();
    const [a, b] = ends.map((end) => {
      corner.set(x.at(Math.min(end, x.high)), y.at(selected), 0).project(camera);
      return [((corner.x + 1) / 2) * box.width + box.left - event.clientX, ((1 - corner.y) / 2) * box.height + box.top - event.clientY];
    });
    if (Math.min(Math.hypot(...a), Math.hypot(...b)) < GRIP_PX) return "end";
    const along = [b[0] - a[0], b[1] - a[1]], length = along[0] ** 2 + along[1] ** 2 || 1;
    const share = Math.min(Math.max(-(a[0] * along[0] + a[1] * along[1]) / length, 0), 1);
    return Math.hypot(a[0] + share * along[0], a[1] + share * along[1]) < GRIP_PX / 2 ? "line" : null;
  }

  // While the hand pulls: the sentence of the motion it pulled at, if it cannot be.
  function say() {
    readout.hidden = !why;
    if (!why) return;
    readout.innerHTML = why;
    placeReadout();
  }

  const pull = coalesce(() => {
    const place = gripped && onFloor(lastMove, true);
    if (!gripped || !place) return;
    model.hand = [gripped, Math.min(Math.max(place[0], 0), Math.PI), Math.min(Math.max(place[1], y.low), y.high)];
    say();
  });
  const release = () => {
    if (!gripped) return;
    gripped = null;
    controls.enabled = true;
    leave();
  };
  // Before the camera's own listener, so that what is pulled is not turned as well.
  picture.addEventListener(
    "pointerdown",
    (event) => {
      gripped = event.isPrimary && event.button === 0 ? gripUnder(event) : null;
      controls.enabled = !gripped;
      if (!gripped) return;
      lastMove = event;
      canvas.setPointerCapture(event.pointerId);
    },
    { capture: true },
  );

  // A finger that pulls does not scroll the page.
  picture.addEventListener(
    "touchstart",
    (event) => event.touches.length === 1 && gripUnder(event.touches[0]) && event.preventDefault(),
    { passive: false },
  );

  function leave() {
    hover.cancel();
    if (readout.hidden) return;
    readout.hidden = true;
    marker.visible = false;
    stage.invalidate();
  }

  const canvas = renderer.domElement;
  let pressed;
  canvas.addEventListener("pointermove", (event) => {
    lastMove = event;
    if (gripped) return pull();
    if (event.buttons) return leave(); // turning, not reading
    canvas.style.cursor = { end: "move", line: "move" }[gripUnder(event)] ?? "";
    hover();
  });
  canvas.addEventListener("pointerleave", () => gripped || leave());
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, release);
  canvas.addEventListener("pointerdown", (event) => (pressed = gripped ? null : event));
  canvas.addEventListener("pointerup", (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > CLICK_PX) return;
    const i = under(event), place = i === null ? onFloor(event) : null;
    if (place) model.hand = ["point", ...place];
    else if (i !== null) model.picked = [K_J[Math.floor(i / columns)], theta[i]];
    lastMove = event;
    hover(); // a finger does not hover: its tap reads the value too
  });

  let aspect;
  function fit(now) {
    const WIDEST = 1.55, look = new THREE.Vector3(0.05, 0, 0.4);
    if (aspect === undefined) {
      camera.position.set(2.2, -4.5, 2.7);
      controls.target.copy(look);
      controls.minDistance = 2;
      controls.maxDistance = 16;
      controls.maxPolarAngle = Math.PI / 2;
      aspect = WIDEST; // the distance above is right for this shape and all wider ones
    }
    const was = Math.min(WIDEST, aspect), is = Math.min(WIDEST, now);
    if (was !== is) camera.position.sub(look).multiplyScalar(was / is).add(look);
    aspect = now;
    controls.update();
    axes.place();
  }

  stage.beforeDraw = () => {
    axes.place();
    labels.place();
  };
  const onData = coalesce(update); // a new scene sets many parameters: one picture
  const onSelected = coalesce(updateSelected);
  for (const name of data) model.on(name, onData);
  for (const name of ["selected", "selected_curve"]) model.on(name, onSelected);
  update();

  const report = {
    get rows() { return rows; },
    get columns() { return columns; },
    get K_J() { return Array.from(K_J); },
    get theta() { return Array.from(theta); },
    get height() { return Array.from(height); },
    get pictures() { return stage.pictures; },
    get selected() { return shown; },
    get grips() { // where on the page the ends of the motion on display can be taken
      const box = picture.getBoundingClientRect();
      return ends.map((end) => {
        corner.set(x.at(end), y.at(selected), 0).project(camera);
        return [((corner.x + 1) / 2) * box.width + box.left, ((1 - corner.y) / 2) * box.height + box.top];
      });
    },
    get readout() { return readout.hidden ? "" : readout.textContent; },
  };
  (window.__tippe ??= {}).surface3d = report;

  const dispose = () => {
    onData.cancel();
    onSelected.cancel();
    hover.cancel();
    pull.cancel();
    if (window.__tippe.surface3d === report) delete window.__tippe.surface3d;
    unfollow();
    stage.dispose();
  };
  view.tippe = { dispose };
  model.on("remove", dispose);
}
