// The present place in the trajectory. Playing advances t with the wall clock; everything else goes to an exact frame.
import { Frames } from "./frames.js";

const LONGEST_STEP_MS = 250; // after the page has been suspended, continue where it stopped

export class Player {
  /**
   * @param {object} tell
   * @param {() => void} tell.changed called when t or playing has changed
   * @param {() => void} tell.landed called when a person or Python has moved the cursor, so that Python can be told
   * @param {() => void} tell.playingChanged
   */
  constructor({ changed, landed, playingChanged }) {
    this.changed = changed;
    this.landed = landed;
    this.playingChanged = playingChanged;
    this.frames = new Frames();
    this.t = 0;
    this.playing = false;
  }

  get place() {
    return this.frames.count ? this.frames.place(this.t) : 0;
  }

  get index() {
    return Math.floor(this.place);
  }

  // A new motion at the same moment: a playing top continues without jumping back to the start.
  /** @param {Bytes} bytes */
  setFrames(bytes) {
    this.frames = new Frames(bytes);
    if (this.playing) this.t = this.wrap(this.t);
    else this.t = this.frames.count ? this.frames.time(this.frames.nearest(this.t)) : 0;
    this.changed();
  }

  /** @param {number} t */
  wrap(t) {
    const { start, end } = this.frames;
    if (!(end > start)) return start;
    return t <= end && t >= start ? t : start + ((((t - start) % (end - start)) + (end - start)) % (end - start));
  }

  // Tells whether the motion started again.
  /** @param {number} now in ms @param {number} unitsPerMs units of the trajectory in one ms of the wall clock */
  advance(now, unitsPerMs) {
    if (this.held) return false;
    const step = this.before === undefined ? 0 : Math.min(now - this.before, LONGEST_STEP_MS);
    this.before = now;
    const t = this.t + step * unitsPerMs;
    this.t = this.wrap(t);
    return this.t < t;
  }

  // Takes the time of another player. Tells whether that one started again.
  /** @param {number} t */
  follow(t) {
    const before = this.t;
    if (this.frames.count) this.t = this.wrap(t);
    return this.t < before;
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing === this.playing) return;
    this.playing = playing;
    this.before = undefined;
    if (!playing) this.land(this.frames.nearest(this.t));
    this.playingChanged();
    this.changed();
  }

  // Goes to a frame by its number, and pauses there.
  /** @param {number} index */
  show(index) {
    if (!this.frames.count) return;
    this.land(Math.min(Math.max(index, 0), this.frames.count - 1));
    this.setPlaying(false);
    this.changed();
  }

  /** @param {number} by */
  step(by) {
    const count = this.frames.count;
    if (count) this.show((this.frames.nearest(this.t) + by + count) % count);
  }

  // Goes to a time; a playing top continues from there once no pointer holds the time any more.
  /** @param {number} t */
  seek(t, held = false) {
    if (!held && this.held) this.before = undefined;
    this.held = held;
    if (!this.frames.count) return;
    if (this.playing) this.t = this.wrap(t);
    else this.land(this.frames.nearest(t));
    this.changed();
  }

  /** @param {number} index */
  land(index) {
    if (!this.frames.count) return;
    this.t = this.frames.time(index);
    this.landed();
  }
}
