// A top's place on its clock. Tops of one clock play as one; a top that names none has the nameless one to itself, or is
// the last on it. The rest of the page asks and tells by events, of which docs/house.md has the list.
import { Player } from "./player.js";

const TELL_MS = 80; // how often a scrub is told to Python
/** @type {Map<string, Place[]>} */
const clocks = new Map(); // name -> the places on it

// The views of the page's one start have one time: one that comes into sight goes on where the last in sight stood.
const OF_THE_START = ["", "lab", "planes"];
let last = { name: "", seconds: NaN }; // the clock of that view, and s of the real top

const on = (name) => clocks.get(name) ?? [];

// Of the tops of one clock, the one that moves the time: the first in view with something to show.
const leaderOf = (name) => on(name).find(({ inView, player }) => inView() && player.frames.count > 1) ?? on(name)[0];

/** The time of a clock, 0 where nothing is on it. @param {string} clock */
export const timeOf = (clock = "") => leaderOf(clock)?.player.t ?? 0;

/** A picture of what leads a clock, so many pixels wide. @param {number} wide */
export const photoOf = (wide, clock = "") => leaderOf(clock)?.photo(wide);

export class Place {
  /**
   * @param {object} top
   * @param {TopModel} top.model
   * @param {HTMLElement} top.picture
   * @param {() => void} top.changed t or playing moved
   * @param {() => boolean} top.inView whether it is seen now
   * @param {(wide: number) => HTMLCanvasElement} top.photo
   * @param {object} top.report what is drawn, for tests
   */
  constructor({ model, picture, changed, inView, photo, report }) {
    this.model = model;
    this.picture = picture;
    this.inView = inView;
    this.photo = photo;
    this.report = report;
    this.name = model.clock;
    this.echo = false;
    this.player = new Player({
      changed: () => {
        changed();
        this.tellOthers();
      },
      landed: () => this.tellTime(),
      playingChanged: () => (model.playing = this.player.playing),
    });
    const { player } = this, listening = new AbortController(), { signal } = listening;
    this.listening = listening;
    model.on("time", () => {
      // What comes back is what was just told: to be passed over, or a scrub would jump back.
      if (Math.abs(model.time - player.t) > 1e-9 * Math.max(1, Math.abs(player.t))) player.seek(model.time);
    });
    model.on("playing", () => player.setPlaying(model.playing));
    window.addEventListener(`tippe:seek${this.suffix}`, ({ detail: { t, held } }) => player.seek(t, held), { signal });
    // The page's own keys, for the tops that are on the page as it is.
    const onCommand = ({ detail: { toggle, step } }) => {
      if (!picture.clientWidth || !this.leads) return;
      if (toggle) player.setPlaying(!player.playing);
      else player.step(step);
    };
    window.addEventListener("tippe:command", onCommand, { signal });
    clocks.set(this.name, [...on(this.name), this]);
    window.__tippe ??= {}; // for tests only
    Object.assign(window.__tippe, { time: timeOf, tops: (clock) => on(clock).map((place) => place.report) });
  }

  get suffix() {
    return this.name ? `:${this.name}` : "";
  }

  get others() {
    return this.name ? on(this.name).filter((other) => other !== this) : [];
  }

  get leader() {
    return this.name ? leaderOf(this.name) : this;
  }

  get leads() {
    return this.leader === this;
  }

  get moves() {
    return this.player.playing && this.player.frames.count > 1;
  }

  // Where the others are, or where Python has it; to be called once, with the first motion there.
  begin() {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches, { model, player } = this;
    player.playing = (this.others[0]?.player ?? model).playing && !still;
    if (model.playing !== player.playing) model.playing = player.playing;
  }

  // The motion that came. Tells whether it is the first. start: to be looked at from its beginning.
  take(start = false) {
    const { model, player } = this, first = !player.frames.count;
    this.echo = true; // a new motion is no news of the clock
    player.setFrames(model.frames);
    if (start) player.land(0);
    this.echo = false;
    if (!first || !player.frames.count) return false;
    if (this.others.length) player.follow(this.leader.player.t);
    else player.seek(model.time);
    return true;
  }

  // The time goes on. model.seconds of the real top pass in one unit of t; speed 1 shows them at their own pace. Tells
  // whether the motion began anew.
  /** @param {number} now in ms */
  advance(now) {
    const { model, player, leads } = this;
    const again = player.advance(now, leads ? model.speed / (1000 * model.seconds) : 0);
    return (!leads && player.follow(this.leader.player.t)) || again;
  }

  // Where it stands, for the view that comes next; once it comes itself, where the last one stood.
  meet() {
    const { name, model, player, picture, player: { frames } } = this;
    if (!OF_THE_START.includes(name) || !this.leads || !picture.clientWidth || frames.count < 2) return;
    if (last.name !== name && Number.isFinite(last.seconds)) {
      const t = last.seconds / model.seconds;
      last = { ...last, name };
      player.seek(name ? Math.min(t, frames.end) : player.wrap(t)); // what rolls goes on for ever
      this.met = player.t;
    } else if (player.t !== this.met) {
      last = { name, seconds: player.t * model.seconds };
      this.met = NaN;
    }
  }

  // Says on the window what the picture shows now, where that is new.
  /** @param {string} verdict */
  say(verdict) {
    this.meet();
    const { t, playing, index } = this.player;
    if (this.said?.t === t && this.said.playing === playing) return;
    this.said = { t, index, playing, verdict };
    if (this.leads) window.dispatchEvent(new CustomEvent(`tippe:clock${this.suffix}`, { detail: this.said }));
  }

  // What a person does to one top of a clock is done to all.
  tellOthers() {
    if (this.echo) return;
    const { player } = this;
    for (const other of this.others) {
      other.echo = true;
      other.player.setPlaying(player.playing);
      if (other.player.t !== player.t) other.player.seek(player.t);
      other.echo = false;
    }
  }

  tellTime() {
    clearTimeout(this.told);
    this.told = setTimeout(() => {
      const { model, player } = this;
      if (!player.playing && !player.held && model.time !== player.t) model.time = player.t;
    }, TELL_MS);
  }

  leave() {
    clearTimeout(this.told);
    this.listening.abort();
    clocks.set(this.name, on(this.name).filter((other) => other !== this));
  }
}
