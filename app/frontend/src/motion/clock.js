// Connects a top to its clock. Tops of the same clock play together; a top without a clock name has one to itself, or
// is the last on the nameless clock. Other parts of the page use events; docs/architecture.md lists them.
import { debounce } from "../data.js";
import { atEnd } from "../life.js";
import { Player } from "./player.js";

const TELL_MS = 80; // ms between two times that are sent to Python while scrubbing
/** @type {Map<string, Place[]>} */
const clocks = new Map(); // name -> the places on it

const on = (name) => clocks.get(name) ?? [];

// The top of a clock that moves the time: the first visible one that has a motion.
const leaderOf = (name) => on(name).find(({ inView, player }) => inView() && player.frames.count > 1) ?? on(name)[0];

/** The time of a clock, 0 if no top is on it. @param {string} clock */
export const timeOf = (clock = "") => leaderOf(clock)?.player.t ?? 0;

/** The reports of the tops of a clock, for tests. @param {string} clock */
export const topsOf = (clock) => on(clock).map((place) => place.report());

/** The tops of a clock that have a motion, also out of sight. @param {string} clock */
export const filmedOn = (clock) => on(clock).filter(({ picture, player }) => picture.clientWidth && player.frames.count);

/** Pictures of the tops that are visible, together `wide` px wide, each with its time in s and its tilt in degrees. @param {number} wide */
export function photosOf(wide) {
  const seen = [...clocks.values()].flat().filter(({ isSeen }) => isSeen);
  return seen.map(({ photo, player, model }) => ({ picture: photo(wide / seen.length), seconds: player.t * model.seconds, tilt: (180 / Math.PI) * player.frames.theta(player.index) }));
}

export class Place {
  /**
   * @param {object} top
   * @param {TopModel} top.model
   * @param {HTMLElement} top.picture
   * @param {() => void} top.changed called when t or playing has changed
   * @param {() => boolean} top.inView whether it is visible
   * @param {(wide: number) => HTMLCanvasElement} top.photo
   * @param {() => object} top.report what is drawn, for tests
   * @param {AbortSignal} top.life
   */
  constructor({ model, picture, changed, inView, photo, report, life }) {
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
      until: () => model.until,
    });
    const { player } = this;
    // Tells Python where it rests.
    this.tellTime = debounce(() => {
      if (!player.playing && !player.held && model.time !== player.t) model.time = player.t;
    }, TELL_MS, life);
    model.on("time", () => {
      // Ignore the echo of the time that we sent ourselves, or scrubbing would jump back.
      if (Math.abs(model.time - player.t) > 1e-9 * Math.max(1, Math.abs(player.t))) player.seek(model.time);
    });
    model.on("playing", () => player.setPlaying(model.playing));
    window.addEventListener(`tippe:seek${this.suffix}`, ({ detail: { t, held } }) => player.seek(t, held), { signal: life });
    // Keys of the page act on the leading top if it is on the page.
    const onCommand = ({ detail: { toggle, step } }) => {
      if (!picture.clientWidth || !this.leads) return;
      if (toggle) player.setPlaying(!player.playing);
      else player.step(step);
    };
    window.addEventListener("tippe:command", onCommand, { signal: life });
    clocks.set(this.name, [...on(this.name), this]);
    atEnd(life, () => clocks.set(this.name, on(this.name).filter((other) => other !== this)));
  }

  get suffix() { return this.name ? `:${this.name}` : ""; }

  get isSeen() { return this.inView() && this.picture.clientWidth > 0 && this.player.frames.count > 0; }

  get others() { return this.name ? on(this.name).filter((other) => other !== this) : []; }

  get leader() { return this.name ? leaderOf(this.name) : this; }

  get leads() { return this.leader === this; }

  get moves() { return this.player.playing && this.player.frames.count > 1; }

  // Takes over the time of the other tops, or Python's; to be called once, with the first motion.
  begin() {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches, { model, player } = this;
    player.playing = (this.others[0]?.player ?? model).playing && !still;
    if (model.playing !== player.playing) model.playing = player.playing;
  }

  // A new motion has arrived; tells whether it is the first. start: play it from its beginning.
  take(start = false) {
    const { model, player } = this, first = !player.frames.count;
    this.echo = true; // a new motion does not change the other tops' clocks
    player.setFrames(model.frames, model.azimuth);
    this.reported = undefined; // the same moment of another motion is news
    if (start) player.land(0);
    this.echo = false;
    if (!first || !player.frames.count) return false;
    if (this.others.length) player.follow(this.leader.player.t);
    else player.seek(model.time);
    return true;
  }

  // Advances the time. One unit of t is model.seconds of the real top; speed 1 is real time. Tells whether the motion
  // started again.
  /** @param {number} now in ms */
  advance(now) {
    const { model, player, leads } = this;
    const again = player.advance(now, leads ? model.speed / (1000 * model.seconds) : 0);
    return (!leads && player.follow(this.leader.player.t)) || again;
  }

  // Sends the present moment as an event, if it is new.
  /** @param {string} verdict */
  say(verdict) {
    const { t, playing, index } = this.player;
    if (this.reported?.t === t && this.reported.playing === playing) return;
    this.reported = { t, index, playing, verdict };
    if (this.leads) window.dispatchEvent(new CustomEvent(`tippe:clock${this.suffix}`, { detail: this.reported }));
  }

  // Does to all tops of the clock what a person did to one of them.
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
}
