// The top on its table. Python sends every pose, path and arrow as numbers: there is no physics here.
import { Bar } from "./bar.js";
import { Place } from "../motion/clock.js";
import { colours } from "../colours.js";
import { coalesce, float32, tidy } from "../data.js";
import { Eye } from "./eye.js";
import { Flick } from "./flick.js";
import { renderFlat } from "./flat.js";
import { Ghost } from "./ghost.js";
import { Handle } from "./handle.js";
import { Impulse } from "./impulse.js";
import { lifeOf, report } from "../life.js";
import { Measured } from "./measured.js";
import { colourOf, wordOf } from "../regimes.js";
import { tryStage } from "./stage.js";
import { frameIn } from "../style.js";
import { part } from "../parts.js";
import { TopScene } from "./top_scene.js";
/** @import { Stage } from "./stage.js" */

// Each is redrawn only when it changes.
const REDRAWN = ["mu_s", "seconds", "show_track", "show_trace", "show_com_path", "show_force", "show_cone", "show_omega", "show_momentum", "follow", "a"];

class Top {
  /** @param {TopModel} model @param {Stage} stage @param {{ root: HTMLElement, picture: HTMLElement, life: AbortSignal }} frame */
  constructor(model, stage, { root, picture, life }) {
    this.model = model;
    this.stage = stage;
    this.life = life;
    this.received = this.drawing = this.shown = 0; // counts of motions: arrived, in the picture being drawn, on the screen
    this.highlight = /** @type {Pointed | null} */ (null); // from a tippe:highlight
    this.scene = new TopScene(stage, life);
    this.eye = new Eye(stage, model, this.scene.stands, () => this.scene.body.reach ?? 2);
    this.verdict = part("div", { class: "verdict" });
    this.scalesText = part("div", { class: "scales" });
    picture.append(this.verdict, this.scalesText);
    this.place = new Place({
      model, picture, life, report: this.report, changed: () => stage.invalidate(),
      inView: () => stage.inView,
      photo: (wide) => {
        this.tick(performance.now(), true); // the screen may not show the present moment yet
        return this.scene.labels.photo(wide);
      },
    });
    this.player = this.place.player;
    this.measured = model.measured === undefined ? null : new Measured(stage, this.scene.labels, model, life);
    this.ghost = model.before === undefined ? null : new Ghost(stage);
    this.handle = model.pulled ? new Handle(stage, this.scene.labels, model.texts, model.pulled) : null;
    this.impulse = model.pushes ? new Impulse(stage, this.scene) : null;
    this.flick = model.flick && this.impulse ? new Flick(stage, this.scene, this.player, model.flick, this.impulse) : null;
    this.bar = model.bare ? null : new Bar(root, picture, model, this.player, () => {
      model.camera = [];
      this.look();
    });
    stage.tick = (now, held) => this.tick(now, held);
    stage.fit = (aspect) => this.eye.fit(aspect);
    stage.turned = () => this.eye.tell();
    stage.shown = () => (this.shown = this.drawing);
    stage.beforeDraw = () => this.scene.labels.place();
  }

  // Looks from the chosen view, or from the first one.
  look() {
    this.eye.begin();
    this.stage.invalidate();
  }

  // Tells Python and the other parts of the page.
  listen() {
    const { model, stage, life } = this, suffix = model.clock ? `:${model.clock}` : "";
    const onFrames = coalesce(() => this.newFrames(), life); // if several arrive in one frame of the screen, only the last is read
    model.on("frames", onFrames);
    model.on("profile", () => this.newProfile());
    for (const name of REDRAWN) model.on(name, () => stage.invalidate());
    if (this.measured) model.on("measured", () => this.newMeasured());
    const { ghost } = this;
    if (ghost) {
      // with the frames, or a picture would be drawn of it beside the motion before
      const onBefore = coalesce(() => ghost.show(model.before ?? null, model.azimuth), life);
      for (const name of ["before", "azimuth"]) model.on(name, onBefore);
      model.on("azimuth", onFrames);
    }
    window.addEventListener(`tippe:highlight${suffix}`, ({ detail }) => {
      this.highlight = detail;
      this.scene.pointedTip.element.textContent = detail?.label ?? "";
      stage.invalidate();
    }, { signal: life });
  }

  begin() {
    this.newProfile();
    if (this.measured) this.newMeasured();
    this.newFrames();
    this.place.begin();
    this.listen();
    if (!this.model.clock || this.handle) report("top3d", this.report, this.life); // that of the page's start
  }

  tick(now, held) {
    if (!held && this.place.moves) this.eye.jumps = this.place.advance(now) || this.eye.jumps;
    this.pose();
    const { now: filmed } = this.model;
    this.eye.follow(filmed ?? now, filmed !== undefined || this.player.playing);
    this.drawing = this.received;
    return this.place.moves;
  }

  // Draws the moment player.t.
  pose() {
    const { model, scene, player: { frames, place, playing } } = this, some = frames.count > 0;
    scene.pose(frames, place, model, this.highlight);
    const { regime, theta } = scene.moment;
    this.handle?.follow(scene.body, theta, some, playing);
    if (!this.flick?.follow()) this.impulse?.replay(model.pushes ?? [], this.player.t * model.seconds, model.speed);
    this.ghost?.follow(this.player.t, model.seconds);
    this.measured?.follow(scene.body, this.player.t);
    this.say(some ? wordOf(regime, model.texts.regimes) : model.texts.no_motion, some ? colourOf(regime) : colours.grey);
  }

  say(word, colour) {
    const { verdict } = this;
    if (verdict.textContent !== word) {
      verdict.textContent = word;
      verdict.style.setProperty("--verdict", colour);
    }
    this.bar?.update(this.model.seconds);
    this.place.say(word);
  }

  newFrames() {
    const first = this.place.take(this.handle?.begins()), { player, scene, model: { texts } } = this;
    this.received += 1;
    scene.setFrames(player.frames);
    const perR = (name) => tidy(1 / scene.scales[name]);
    this.scalesText.innerHTML =
      `${texts.scales}<br><i>F</i> ${perR("force")} <i>Mg</i><br><i>ω</i> ${perR("omega")} (<i>g</i>/<i>R</i>)<sup>½</sup><br>` +
      `<i>L</i> ${perR("momentum")} <i>MR</i>²(<i>g</i>/<i>R</i>)<sup>½</sup>`;
    if (first) {
      this.pose();
      this.eye.begin();
    } else if (!player.playing) this.eye.jumps = true;
  }

  newMeasured() {
    this.measured?.read();
    this.stage.invalidate();
  }

  // A person's zoom is kept, relative to the size of the body.
  newProfile() {
    const { scene, eye } = this, { body } = scene, was = body.reach ?? 2;
    body.setProfile(float32(this.model.profile));
    if (body.reach) {
      eye.zoom(body.reach / was);
      eye.fitBody();
      scene.fitTo(body.reach);
    }
    this.stage.invalidate();
  }

  report = () => {
    const { player: { t, playing, frames }, place, scene: { body, pointedAt }, stage: { pictures }, eye, model: { label }, verdict, received, shown } = this;
    return {
      t, playing, pictures, label, index: place.reported?.index, count: frames.count, position: body.position.toArray(), quaternion: body.quaternion.toArray(),
      eye: eye.direction, verdict: verdict.textContent, motions: { received, shown }, highlight: pointedAt.visible ? this.highlight?.label : "",
    };
  };
}

/** @param {Rendering<TopModel>} rendering */
export function renderTop3D(rendering) {
  const { model, el } = rendering, life = lifeOf(rendering, { look: () => top?.look() });
  const { root, picture } = frameIn(el), { texts } = model, label = model.label || texts.label;
  if (!model.clock || model.pulled) picture.dataset.picture = "top";
  const stage = tryStage(picture, { label, texts, fov: 30, life });
  const top = stage && new Top(model, stage, { root, picture, life });
  if (top) top.begin();
  else renderFlat(model, { root, picture, life });
  model.on("label", () => picture.querySelector("canvas")?.setAttribute("aria-label", model.label));
}
