// The time of the Lab's pictures. The tops play by themselves on one clock; this sets when and how fast, and announces
// the time that they show.
import { tempo } from "../motion/curves.js";
import { followClock, LAB, seek } from "../figures/seeking.js";

export const SPEEDS = [8, 4, 2, 1, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 32, 1 / 64]; // in units of real time

export class Time {
  /** @param {() => void} changed t or playing has changed @param {AbortSignal} life @param {string} name of the tops' clock */
  constructor(changed, life, name = LAB) {
    this.changed = changed;
    this.name = name;
    this.t = 0; // s
    this.unit = 1; // s in one unit of the tops' time
    this.end = 0; // s
    this.span = 0; // s: length of the axes; the run may not be complete yet
    this.playing = false;
    this.held = false;
    this.chosen = 0; // the speed that a person chose; 0: none
    this.chose = (speed) => void (this.chosen = speed);
    /** @type {any[][]} */
    this.events = [];
    /** @type {any[]} */
    this.tops = [];
    followClock((detail) => this.hear(detail), name, life);
  }

  // The speed if it is at least the real one and no person chose it; 0 otherwise, and while nothing moves.
  get fast() { return this.playing && !this.chosen && this.speed >= 1 ? this.speed : 0; }

  get speed() { return this.chosen || tempo(this.events, this.t, this.end); }

  hear({ t, playing }) {
    if (this.held) return;
    this.t = Math.min(t * this.unit, this.end);
    this.playing = playing;
    this.changed();
  }

  /** @param {number} t in s @param {boolean} held while it is dragged */
  seek(t, held = false) {
    this.t = Math.min(Math.max(t, 0), this.end);
    this.held = held;
    seek(this.t / this.unit, held, this.name);
    this.changed();
  }

  // Plays from the present time; the tops start again if that is the end.
  /** @param {boolean} playing */
  play(playing) {
    this.playing = playing;
    for (const top of this.tops) top.put({ playing });
    this.changed();
  }

  // While the tops play, only a person can set their time.
  again() {
    this.seek(0, true);
    this.seek(0);
  }
}
