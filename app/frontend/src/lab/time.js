// The time of the Lab's pictures. The tops play by themselves, on one clock; this says when and how fast, and tells
// what they show.
import { tempo } from "./curves.js";

const CLOCK = "lab";
export const SPEEDS = [8, 4, 2, 1, 1 / 2, 1 / 4, 1 / 8, 1 / 16]; // in times the real one
const LONGEST_STEP = 0.25; // s: a top's time goes on by at most so much of the wall clock at once
const NEARLY = 0.02; // s

export class Time {
  /** @param {() => void} changed t or playing is another @param {string} name of the tops' clock */
  constructor(changed, name = CLOCK) {
    this.changed = changed;
    this.name = name;
    this.t = 0; // s
    this.unit = 1; // s in one unit of the tops' own time
    this.end = 0; // s
    this.span = 0; // s: of the axes; there may be more to come
    this.playing = false;
    this.held = false;
    this.chosen = 0; // the speed that a person chose; 0: none
    /** @type {any[][]} */
    this.events = [];
    /** @type {any[]} */
    this.tops = [];
    this.listening = new AbortController();
    window.addEventListener(`tippe:clock:${name}`, ({ detail }) => this.hear(detail), { signal: this.listening.signal });
  }

  // The speed that is no slower than the real one, unless a person chose it or nothing moves; else 0.
  get fast() {
    return this.playing && !this.chosen && this.speed >= 1 ? this.speed : 0;
  }

  get speed() {
    return this.chosen || tempo(this.events, this.t, this.end);
  }

  // Of the tops: their longest step ends at the end at most, where they would begin anew.
  get pace() {
    return Math.min(this.speed, Math.max(this.end - this.t, 0) / LONGEST_STEP);
  }

  hear({ t, playing }) {
    if (this.held) return;
    this.t = Math.min(t * this.unit, this.end);
    this.playing = playing;
    if (playing && this.t > this.end - NEARLY) this.rest();
    this.changed();
  }

  rest() {
    this.play(false);
    this.seek(this.end);
  }

  /** @param {number} t in s @param {boolean} held while a hand moves it */
  seek(t, held = false) {
    this.t = Math.min(Math.max(t, 0), this.end);
    this.held = held;
    window.dispatchEvent(new CustomEvent(`tippe:seek:${this.name}`, { detail: { t: this.t / this.unit, held } }));
    this.changed();
  }

  // From where it is; from the start where it is at its end.
  /** @param {boolean} playing */
  play(playing) {
    if (playing && this.t > this.end - NEARLY) this.again();
    this.playing = playing;
    for (const top of this.tops) top.put({ playing });
    this.changed();
  }

  // Tops that play take a time only from a hand.
  again() {
    this.seek(0, true);
    this.seek(0);
  }

  leave() {
    this.listening.abort();
  }
}
