// The present place in the trajectory. Playing advances t with the wall clock; everything else goes to an exact frame.
// A motion repeats forever, or it is played once: then it pauses at its end, however it got there.
import { Frames } from "./frames.js";

const NEARLY = 1 / 500; // of a motion that is played once: this close to its end is its end, because times are rounded
const LONGEST_STEP_MS = 250; // after the page has been suspended, continue where it stopped

export class Player {
  /**
   * @param {object} tell
   * @param {() => void} tell.changed called when t or playing has changed
   * @param {() => void} tell.landed called when a person or Python has moved the cursor, so that Python can be told
   * @param {() => void} tell.playingChanged
   * @param {() => number | undefined} [tell.until] the time to which the motion is played once; undefined if it repeats
   */
  constructor({ changed, landed, playingChanged, until = () => undefined }) {
    this.changed = changed;
    this.landed = landed;
    this.playingChanged = playingChanged;
    this.until = until;
    this.frames = new Frames();
    this.t = 0;
    this.playing = false;
  }

  get place() { return this.frames.count ? this.frames.place(this.t) : 0; }

  get index() { return Math.floor(this.place); }

  // Where playing ends; Infinity if it repeats.
  get last() {
    const until = this.until();
    return until === undefined ? Infinity : Math.min(this.frames.end, until);
  }

  // Whether a time is at that end.
  /** @param {number} t */
  isEnd(t) {
    const { frames: { count, start }, last } = this;
    return count > 0 && last < Infinity && t >= last - NEARLY * (last - start);
  }

  // A new motion at the same moment: a playing top continues without jumping back to the start, unless it is over by
  // then.
  /** @param {Bytes} bytes @param {number} [azimuth] as of Frames */
  setFrames(bytes, azimuth) {
    this.frames = new Frames(bytes, azimuth);
    if (this.playing) this.t = this.isEnd(this.t) ? this.frames.start : this.within(this.t);
    else this.t = this.frames.count ? this.stand(this.t) : 0;
    this.changed();
  }

  // The time of the motion that belongs to any time.
  /** @param {number} t */
  within(t) {
    return this.last === Infinity ? this.wrap(t) : Math.max(Math.min(t, this.last), this.frames.start);
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
    const t = this.t + step * unitsPerMs, before = this.t;
    this.t = this.within(t);
    if (unitsPerMs && this.t === this.last) this.setPlaying(false); // a top that follows another one does not decide
    return this.t < before;
  }

  // Takes the time of another player. Tells whether that one started again.
  /** @param {number} t */
  follow(t) {
    const before = this.t;
    if (this.frames.count) this.t = this.within(t);
    return this.t < before;
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing === this.playing) return;
    this.playing = playing;
    this.before = undefined;
    if (playing && this.isEnd(this.t)) this.t = this.frames.start;
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

  // Goes to a time; a playing top continues from there once no pointer holds the time any more, but not from the end.
  /** @param {number} t */
  seek(t, held = false) {
    if (!held && this.held) this.before = undefined;
    this.held = held;
    if (!this.frames.count) return;
    if (this.playing && !held && this.isEnd(t)) this.setPlaying(false);
    this.t = this.playing ? this.within(t) : this.stand(t);
    if (!this.playing) this.landed();
    this.changed();
  }

  // Where a paused motion stands for a time: on a frame if it repeats, else there, also between two frames.
  /** @param {number} t */
  stand(t) { return this.last < Infinity ? this.within(t) : this.frames.time(this.frames.nearest(t)); }

  /** @param {number} index */
  land(index) {
    if (!this.frames.count) return;
    this.t = this.frames.time(index);
    this.landed();
  }
}
