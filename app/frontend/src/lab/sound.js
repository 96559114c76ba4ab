// The sound of the run that plays: its rubbing, its hum, and what touches the table. Off until a person switches it on
// in the menu, in this page alone; it stops with the clock.
import { Frames } from "../motion/frames.js";
import { heardOf, listening } from "../motion/heard.js";

const STILL = 0.2, EASE = 0.03; // s after which it fades if the clock has stopped; of a change
const RUB = 0.5, SLIP = 2, TURN = 7, TOUCH = 0.25; // as of heardOf(): what is as loud, or as high, as it gets
const LOUD = { rub: 0.35, hum: 0.08, touch: 0.9 };
const HUM = 8; // Hz for a turn a second: lower ones no small loudspeaker has
const LEAP = 0.3; // s: what is farther from the last time was not played

// What makes the sounds. Each fades by itself unless it is asked for again.
class Voices {
  constructor() {
    const context = (this.context = new AudioContext());
    this.noise = context.createBuffer(1, context.sampleRate, context.sampleRate);
    this.noise.getChannelData(0).forEach((_, i, samples) => (samples[i] = 2 * Math.random() - 1));
    this.filter = this.band(1000);
    this.rubbing = this.loudness(this.filter);
    this.murmur().connect(this.filter);
    this.oscillator = context.createOscillator();
    this.humming = this.loudness(this.oscillator);
    this.oscillator.start();
  }

  murmur() {
    const source = Object.assign(this.context.createBufferSource(), { buffer: this.noise, loop: true });
    source.start();
    return source;
  }

  /** @param {number} frequency */
  band(frequency) {
    const filter = Object.assign(this.context.createBiquadFilter(), { type: "bandpass" });
    filter.frequency.value = frequency;
    return filter;
  }

  // How loud a source is: not at all at first.
  /** @param {AudioNode} source */
  loudness(source) {
    const gain = this.context.createGain();
    gain.gain.value = 0;
    source.connect(gain).connect(this.context.destination);
    return gain.gain;
  }

  /** @param {AudioParam} gain @param {number} value */
  set(gain, value) {
    const now = this.context.currentTime;
    gain.cancelScheduledValues(now);
    gain.setTargetAtTime(value, now, EASE);
    gain.setTargetAtTime(0, now + STILL, EASE);
  }

  /** @param {number} loud from 0 to 1 @param {number} high from 0 to 1 */
  rub(loud, high) {
    this.filter.frequency.value = 500 + 2000 * high;
    this.set(this.rubbing, LOUD.rub * loud);
  }

  /** @param {number} loud @param {number} frequency in Hz */
  hum(loud, frequency) {
    this.oscillator.frequency.value = frequency;
    this.set(this.humming, LOUD.hum * loud);
  }

  /** @param {number} loud */
  touch(loud) {
    const now = this.context.currentTime, source = this.murmur(), gain = this.loudness(source.connect(this.band(1400)));
    gain.setValueAtTime(LOUD.touch * loud, now);
    gain.exponentialRampToValueAtTime(1e-3, now + 0.12);
    source.stop(now + 0.15);
  }
}

export class Sound {
  constructor() {
    /** @type {Voices | null} */
    this.voices = null;
    this.t = 0;
    this.frames = new Frames();
    this.heard = heardOf(this.frames);
  }

  show(scene) {
    this.unit = scene.unit;
    this.wanted = scene.frames[scene.table === "three" ? "ordinary" : scene.table];
  }

  /** @param {number} t in s @param {boolean} playing */
  at(t, playing) {
    const { unit } = this, was = this.t;
    this.t = t;
    if (!listening.on) return this.leave();
    if (!playing) return void this.voices?.context.suspend();
    const voices = (this.voices ??= new Voices());
    if (this.read !== this.wanted) {
      this.read = this.wanted;
      this.frames = new Frames(this.read);
      this.heard = heardOf(this.frames);
    }
    if (!this.frames.count) return;
    voices.context.resume();
    const { slip, rub, turn, touches } = this.heard, i = this.frames.nearest(t / unit), share = (value, most) => Math.min(value / most, 1);
    voices.rub(Math.sqrt(share(rub[i], RUB)), share(slip[i], SLIP));
    voices.hum(share(turn[i], TURN), (HUM * turn[i]) / (2 * Math.PI * unit));
    if (t <= was || t - was > LEAP) return;
    const [from, to] = [was, t].map((time) => this.frames.place(time / unit));
    for (const [place, impulse] of touches) if (place > from && place <= to) voices.touch(Math.sqrt(share(impulse, TOUCH)));
  }

  leave() {
    this.voices?.context.close();
    this.voices = null;
  }
}
