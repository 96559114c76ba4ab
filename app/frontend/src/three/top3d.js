// The top on its table. Every pose, path and arrow is a number that Python sent: there is no physics here.
import * as THREE from "three";
import { Arrow } from "./arrow.js";
import { Bar } from "../widgets/bar.js";
import { Body } from "./body.js";
import { frictionCone } from "./cone.js";
import { Place } from "../motion/clock.js";
import { colours } from "../colours.js";
import { coalesce, float32, niceAbove, tidy } from "../data.js";
import { renderFlat } from "../figures/flat.js";
import { emptyPose } from "../motion/frames.js";
import { colourOf, ROLLS, wordOf } from "../regimes.js";
import { Handle } from "./handle.js";
import { Labels } from "./labels.js";
import { photo } from "./photo.js";
import { Ribbon, Thread } from "./ribbon.js";
import { followLook } from "./scene.js";
import { tryStage } from "./stage.js";
import { blobMaterial, dressTable, makeTable, TABLE } from "./table.js";
import { addText, frameIn } from "../style.js";
/** @import { Stage } from "./stage.js" */

const SHADE = 4.5; // half the side of the square that can be in shadow
const ABOVE_TABLE = 0.006; // lines on the table lie this high, so that the table does not swallow them
const FOLLOW_MS = 160; // the camera follows the top's drift, not each of its small turns
const FIRST_VIEW = [-1.12, 0.3, 1];
const LONGEST = { force: 1.8, omega: 2.2, momentum: 1.7 }; // the longest arrow of a motion is at most this long, in R

/** @param {Rendering<TopModel>} rendering */
export function renderTop3D({ model, el, view }) {
  view.tippe?.dispose(); // Panel may build a view anew without saying "remove"
  const { root, picture } = frameIn(el), { texts } = model, label = model.label || texts.label;
  if (!model.clock) picture.dataset.picture = "top";
  const stage = /** @type {Stage} */ (tryStage(picture, { label, texts, fov: 30, tick, fit, turned, shown: () => (shown = drawing) }));
  if (!stage) return renderFlat({ model, root, picture, view });
  const { scene, camera, controls, renderer } = stage;

  // The table, the light, and the shadow that stands where the top is
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  const background = (scene.background = new THREE.Color()), fog = (scene.fog = new THREE.Fog(0, 9, TABLE - 2));
  const table = makeTable();
  const shade = new THREE.Mesh(
    new THREE.PlaneGeometry(2 * SHADE, 2 * SHADE),
    new THREE.ShadowMaterial({ color: 0x2a2118, opacity: 0.34, depthWrite: false }),
  );
  shade.receiveShadow = true;
  scene.add(table, shade);
  scene.add(new THREE.HemisphereLight(0xffffff, 0xb9a88f, 1.7));
  const sun = new THREE.DirectionalLight(0xfff4e2, 2.1);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  sun.shadow.radius = 3;
  sun.shadow.bias = -0.002;
  Object.assign(sun.shadow.camera, { left: -3.2, right: 3.2, top: 3.2, bottom: -3.2, near: 4, far: 16 });
  scene.add(sun, sun.target);
  const underneath = new THREE.Mesh(new THREE.PlaneGeometry(1.5, 1.5), blobMaterial());
  underneath.renderOrder = -1;
  scene.add(underneath);

  const body = new Body();
  scene.add(body);

  // Paths: the whole one faintly, what has passed boldly
  const track = {
    whole: new Ribbon(0.028, { color: colours.theta, opacity: 0.25 }),
    passed: new Ribbon(0.045, { color: colours.theta, opacity: 0.95 }),
  };
  const comPath = {
    whole: new Thread({ opacity: 0.3 }),
    passed: new Thread({ opacity: 0.9 }),
  };
  for (const line of [...Object.values(track), ...Object.values(comPath)]) scene.add(line);

  // Arrows, the friction cone, and the marks of C and G
  const arrows = {
    force: new Arrow(colours.normal, { radius: 0.045, through: 0.85 }),
    omega: new Arrow(colours.omega),
    momentum: new Arrow(colours.momentum, { radius: 0.055 }),
  };
  for (const arrow of Object.values(arrows)) scene.add(arrow);
  const pointedAt = new Arrow(0, { radius: 0.05, through: 0.85 }); // what a text beside points at, alone
  scene.add(pointedAt);
  const cone = frictionCone();
  scene.add(cone);
  const centre = new THREE.Mesh(
    new THREE.SphereGeometry(0.045, 16, 12),
    new THREE.MeshBasicMaterial({ depthTest: false, transparent: true }),
  );
  centre.renderOrder = 4;
  scene.add(centre);
  const labels = new Labels(stage);
  const tips = {
    force: labels.add("F", "vector"),
    omega: labels.add("ω", "vector"),
    momentum: labels.add("L", "vector"),
    centre: labels.add("G", "vector"),
  };
  const pointedTip = labels.add("", "vector");
  const unfollow = followLook((look) => {
    for (const colour of [background, fog.color]) colour.set(look.sky);
    dressTable(table, look);
    for (const { material } of [comPath.whole, comPath.passed, centre]) material.color.set(look.ink);
    shade.material.color.set(look.shade);
    pointedAt.colour = look.ink;
    for (const name of ["force", "omega", "momentum"]) tips[name].element.style.color = look[name];
    stage.invalidate();
  });

  const verdict = addText(picture, "verdict");
  const scalesText = addText(picture, "scales");

  // What is drawn, for tests
  const report = {
    get t() { return player.t; },
    get index() { return place.said?.index; },
    get count() { return player.frames.count; },
    get playing() { return player.playing; },
    get position() { return body.position.toArray(); },
    get quaternion() { return body.quaternion.toArray(); },
    get eye() { return camera.position.clone().sub(seen).normalize().toArray(); },
    get label() { return label; },
    get verdict() { return verdict.textContent; },
    get pictures() { return stage.pictures; },
    get motions() { return { received, shown }; },
    get highlight() { return pointedAt.visible ? highlight?.label : ""; },
  };
  const place = new Place({
    model, picture, report,
    changed: () => stage.invalidate(),
    inView: () => stage.inView,
    photo: (wide) => photo(stage, labels, wide),
  });
  const { player } = place;
  const handle = model.tiltable ? new Handle(stage, labels, model, player) : null;
  const bar = new Bar(root, picture, model, player, () => {
    model.camera = [];
    firstView();
    stage.invalidate();
  });

  const moment = emptyPose(); // what Python says of player.t
  const seen = new THREE.Vector3(); // the point that the camera looks at
  const stands = new THREE.Vector3(); // the sphere's centre
  const scales = {};
  let restarted = true;
  let lastFrame;
  let highlight = /** @type {Pointed | null} */ (null); // of a tippe:highlight
  const suffix = model.clock ? `:${model.clock}` : "";
  let received = 0, drawing = 0, shown = 0; // motions that came; the last of them in the picture begun, and on the screen

  function tick(now, held) {
    if (!held && place.moves) restarted = place.advance(now) || restarted;
    pose();
    follow(now);
    drawing = received;
    return place.moves;
  }

  // The picture of the moment player.t
  function pose() {
    const { frames, place: at } = player;
    const some = frames.count > 0;
    body.visible = underneath.visible = some;
    centre.visible = some && model.show_com_path;
    if (some) {
      frames.read(at, moment);
      stands.set(moment.contact.x, moment.contact.y, 1);
      body.quaternion.copy(moment.quaternion);
      body.position.copy(stands);
      // off the table, or on its stem, the sphere's centre is where G and the axis say
      if (model.a !== null) body.position.set(0, 0, model.a).applyQuaternion(moment.quaternion).add(moment.com);
      underneath.position.set(stands.x, stands.y, ABOVE_TABLE / 2);
      shade.position.set(stands.x + 1.2, stands.y + 1.3, ABOVE_TABLE / 3);
      centre.position.copy(moment.com);
      sun.target.position.copy(stands);
      sun.position.set(stands.x - 3.2, stands.y - 3.4, 8.2);
      table.position.set(Math.round(stands.x / 5) * 5, Math.round(stands.y / 5) * 5, 0); // the grid repeats each 5 R
      arrows.force.colour = moment.regime === ROLLS ? colours.normal : colourOf(moment.regime);
    }
    point("force", moment.contact, moment.force, some && model.show_force);
    point("omega", moment.com, moment.omega, some && model.show_omega);
    point("momentum", moment.com, moment.momentum, some && model.show_momentum);
    showPointed(some);
    tips.centre.visible = centre.visible;
    tips.centre.at.copy(moment.com);
    tips.centre.shift = [-14, 6];

    // As high as the arrow reaches: its tip is then inside the rim where the top can roll.
    const height = moment.force.z * scales.force;
    cone.visible = some && model.show_cone && height > 1e-3 && model.mu_s > 0;
    cone.position.copy(moment.contact);
    cone.scale.set(height * model.mu_s, height * model.mu_s, height);

    handle?.follow(body, some && !player.playing);

    const passed = Math.ceil(at);
    show(track, model.show_track, passed, frames.count);
    show(comPath, model.show_com_path, passed, frames.count);

    const [word, colour] = some ? [wordOf(moment.regime, texts.verdicts), colourOf(moment.regime)] : [texts.no_motion, colours.grey];
    if (verdict.textContent !== word) {
      verdict.textContent = word;
      verdict.style.setProperty("--verdict", colour);
    }
    bar.update(model.seconds);
    place.say(word);
  }

  // A vector along the turning axes 1', y, z, from "com" or "contact": only its direction is true where it is long.
  function showPointed(some) {
    const axis = new THREE.Vector3(0, 0, 1).applyQuaternion(moment.quaternion);
    const first = new THREE.Vector3(-axis.y, axis.x, 0).normalize(); // 1' = z x 3
    const [x, y, z] = highlight?.vector ?? [0, 0, 0];
    const along = new THREE.Vector3(first.x * x - first.y * y, first.y * x + first.x * y, z);
    along.clampLength(0.4, 1.8);
    pointedAt.point(highlight?.start === "contact" ? moment.contact : moment.com, along.x, along.y, along.z, pointedTip.at);
    pointedAt.visible = pointedTip.visible = some && Boolean(highlight) && pointedAt.drawable;
    if (!pointedAt.visible) return;
    pointedTip.shift = [14, -6];
    for (const name of Object.keys(arrows)) arrows[name].visible = tips[name].visible = false;
  }

  function point(name, from, vector, visible) {
    const arrow = arrows[name], tip = tips[name], scale = scales[name] ?? 1;
    arrow.point(from, vector.x * scale, vector.y * scale, vector.z * scale, tip.at);
    arrow.visible = tip.visible = visible && arrow.drawable;
    tip.shift = name === "omega" ? [16, -4] : [-15, -6];
  }

  function show(line, visible, passed, count) {
    line.whole.points = visible ? count : 0;
    line.passed.points = visible ? passed + 1 : 0;
  }

  // The camera moves along with the top, keeping the direction a person chose.
  function follow(now) {
    const ms = lastFrame === undefined ? 0 : now - lastFrame;
    lastFrame = player.playing ? now : undefined;
    const share = restarted || !player.playing ? 1 : 1 - Math.exp(-ms / FOLLOW_MS);
    restarted = false;
    if (model.follow) moveView((stands.x - seen.x) * share, (stands.y - seen.y) * share);
  }

  function moveView(dx, dy) {
    seen.x += dx;
    seen.y += dy;
    camera.position.x += dx;
    camera.position.y += dy;
    controls.target.copy(seen);
    camera.lookAt(seen);
  }

  // Far enough for the whole top with its stem and the arrows, whatever the shape of the window.
  function distance() {
    const half = Math.atan(Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)) * Math.min(1, camera.aspect));
    return (body.reach ?? 2) / Math.sin(half);
  }

  function firstView() {
    seen.set(stands.x, stands.y, 1.25);
    const [azimuth, height, times] = model.camera.length ? model.camera : FIRST_VIEW, far = distance() * times;
    camera.position.set(
      seen.x + far * Math.cos(height) * Math.cos(azimuth),
      seen.y + far * Math.cos(height) * Math.sin(azimuth),
      seen.z + far * Math.sin(height),
    );
    controls.target.copy(seen);
    controls.minDistance = 1.6;
    controls.maxDistance = 22;
    controls.maxPolarAngle = Math.PI / 2 - 0.02; // never from below the table
    controls.update();
  }

  // A person has turned or zoomed: as seen from what the camera looks at.
  function turned() {
    const { x, y, z } = camera.position.clone().sub(seen), far = Math.hypot(x, y, z);
    model.camera = [Math.atan2(y, x), Math.asin(z / far), far / distance()].map((value) => Number(value.toFixed(3)));
  }

  let aspect;
  function fit(now) {
    if (aspect === undefined) firstView();
    else {
      // A person's own zoom is kept: only what the new shape takes away is given back.
      const was = Math.min(1, aspect), is = Math.min(1, now);
      if (was !== is) camera.position.sub(seen).multiplyScalar(was / is).add(seen);
    }
    aspect = now;
  }

  stage.beforeDraw = () => labels.place();

  // Python's side
  function newFrames() {
    const first = place.take(handle?.begins());
    received += 1;
    const { frames } = player;
    const most = frames.scales;
    for (const name of Object.keys(LONGEST)) scales[name] = 1 / niceAbove(most[name] / LONGEST[name]);
    const perR = (name) => tidy(1 / scales[name]);
    scalesText.innerHTML =
      `${texts.scales}<br><i>F</i> ${perR("force")} <i>Mg</i><br><i>ω</i> ${perR("omega")} (<i>g</i>/<i>R</i>)<sup>½</sup><br>` +
      `<i>L</i> ${perR("momentum")} <i>MR</i>²(<i>g</i>/<i>R</i>)<sup>½</sup>`;
    for (const line of Object.values(track)) line.setPath(frames.count, (i) => frames.contact(i), ABOVE_TABLE);
    for (const line of Object.values(comPath)) line.setPath(frames.count, (i, put) => frames.com(i, put));
    if (first) {
      pose();
      firstView();
    } else if (!player.playing) restarted = true;
  }

  function newProfile() {
    const was = body.reach ?? 2;
    body.setProfile(float32(model.profile));
    // A person's own zoom is kept, in terms of the body's size.
    if (body.reach && body.reach !== was) camera.position.sub(seen).multiplyScalar(body.reach / was).add(seen);
    stage.invalidate();
  }

  const onFrames = coalesce(newFrames); // several in one frame of the screen: only the last is read
  model.on("frames", onFrames);
  model.on("profile", newProfile);
  for (const name of ["mu_s", "seconds", "show_track", "show_com_path", "show_force", "show_cone", "show_omega", "show_momentum", "follow", "a"]) {
    model.on(name, () => stage.invalidate());
  }
  const onHighlight = ({ detail }) => {
    highlight = detail;
    pointedTip.element.textContent = detail?.label ?? "";
    stage.invalidate();
  };
  window.addEventListener(`tippe:highlight${suffix}`, onHighlight);

  newProfile();
  newFrames();
  place.begin();
  if (!model.clock) window.__tippe.top3d = report;

  const dispose = () => {
    onFrames.cancel();
    place.leave();
    window.removeEventListener(`tippe:highlight${suffix}`, onHighlight);
    if (window.__tippe.top3d === report) delete window.__tippe.top3d;
    unfollow();
    stage.dispose();
  };
  view.tippe = { dispose };
  model.on("remove", dispose);
}
