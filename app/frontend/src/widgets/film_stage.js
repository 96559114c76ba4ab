// A top that moves once, on its own clock: a button that plays it, the time and the tilt; for a measured film, also the
// axis as seen on it.
import { Top } from "../three/top.js";
import { icon, part, say } from "../parts.js";
import { coalesce, float32 } from "../data.js";
import { followClock, seek } from "../figures/seeking.js";
import { frame } from "../controls/frame.js";
import { timed } from "../controls/style.js";
import { follow } from "../life.js";

const PACE = 1 / 8; // in units of the real top's speed
const style = `${timed} .frame, .film { height: 100%; } .film { position: relative; min-height: 260px; border-radius: 6px; overflow: hidden; background: var(--scene); }
.none { position: absolute; inset: auto 16px 16px; color: var(--scene-faint); } .film .round { position: absolute; right: 16px; bottom: 12px; }`;

/** @param {Rendering<FilmStageModel>} rendering */
export function renderFilmStage(rendering) {
  const { model } = rendering, { texts, clock } = model, place = part("div", { class: "film" }), life = frame(rendering, style, place);
  const top = new Top({ texts, life, label: model.label, away: 1.05, time: /** @type {any} */ ({ name: clock, speed: PACE, end: Infinity, unit: 1 }) });
  Object.assign(top.model, { measured: model.measured, measured_label: model.measured_label, playing: false, show_track: true });
  const pill = part("div", { class: "pill", hidden: true });
  const none = part("p", { class: "none" }, model.none);
  const play = part("button", { type: "button", class: "round", onclick: () => put({ playing: !top.model.playing }) });
  place.append(top.element, pill, none, play);

  function put(changes) {
    top.put(changes);
    const name = top.model.playing ? "pause" : "play";
    play.replaceChildren(icon(name));
    play.setAttribute("aria-label", texts[name]);
  }
  let tilts = new Float32Array(), shown = model.frames, shows = false;
  followClock(({ t, index, playing }) => {
    if (playing !== top.model.playing) put({ playing });
    const tilt = tilts[Math.min(index, tilts.length - 1)];
    pill.textContent = tilt === undefined ? "" : say(texts, texts.pill, { t: [t, 2], tilt: [tilt, 0] });
    if (!playing) top.describe(pill.textContent);
  }, clock, life);
  const show = coalesce(() => {
    const some = Boolean(float32(model.frames).length);
    tilts = float32(model.tilts);
    pill.hidden = play.hidden = !some;
    none.hidden = some;
    top.element.hidden = !some;
    if (some && !shows) top.model.time = model.start; // where a motion begins that comes after none
    put({ ...(!some && { playing: false }), profile: model.profile, a: model.a, measured_label: model.measured_label, measured: model.measured, frames: model.frames });
    if (some) top.begin();
    if (some && shows && model.anew && shown !== model.frames) seek(model.start, false, clock);
    [shown, shows] = [model.frames, some];
  }, life);
  follow(model, ["frames", "profile", "tilts", "measured", "a"], show);
}
