import assert from "node:assert/strict";
import { test } from "node:test";
import { Frames } from "../../app/frontend/src/motion/frames.js";
import { Sound } from "../../app/frontend/src/lab/sound.js";
import { heardOf, listening } from "../../app/frontend/src/motion/heard.js";
import { motion, near } from "./helping.js";

const heard = (rows) => heardOf(new Frames(motion(rows)));
const times = Array.from({ length: 21 }, (_, i) => i / 20);

test("what rubs is the point that touches: a ball that rolls is silent, one that spins on the spot or slides is not", () => {
  // G moves along x at 2, the ball turns about y; its lowest point is 1 below G
  const moves = (omega) => times.map((t) => ({ t, com: [2 * t, 0, 1], contact: [2 * t, 0], omega: [0, omega, 0], force: [-0.3, 0.4, 1] }));
  near(heard(moves(2)).slip, times.map(() => 0), 1e-5);
  near(heard(moves(0)).slip, times.map(() => 2), 1e-5);
  near(heard(moves(-1)).rub, times.map(() => 3 * 0.5), 1e-5);
  near(heard(moves(-1)).turn, times.map(() => 1));
});

test("in the air nothing rubs, and what falls and stays is heard once, with its impulse", () => {
  const rows = times.map((t) => ({ t, com: [0, 0, 1 + Math.max(0.125 - t ** 2 / 2, 0)], omega: [0, 0, 5], contact: [0.1, 0], force: [0, 0, Number(t > 0.5)] }));
  const { rub, slip, touches } = heard(rows);
  assert.ok(rub.every((each) => each === 0) && slip[2] === 0);
  near(slip[20], 0.5); // it spins about an axis 0.1 beside the point that touches
  const total = touches.reduce((sum, [, impulse]) => sum + impulse, 0);
  near(total, 0.5, 0.06); // it fell for 0.5
  assert.ok(touches.every(([place]) => Math.abs(place - 10) <= 1));
});

test("a steady load is no impulse, nor is a motion of one frame or none", () => {
  assert.deepEqual(heard(times.map((t) => ({ t, com: [0, 0, 1 + 0.1 * Math.cos(2 * t)], force: [0, 0, 1 - 0.4 * Math.cos(2 * t)] }))).touches, []);
  assert.deepEqual([heard([]).slip.length, heard([{ t: 0 }]).touches.length], [0, 0]);
});

// A browser's sound, of which only what is set is kept.
const param = () => ({ value: 0, aims: [], cancelScheduledValues() {}, setValueAtTime() {}, exponentialRampToValueAtTime() {}, setTargetAtTime(...aim) { this.aims.push(aim); } });
const node = () => ({ frequency: param(), gain: param(), connect: (next) => next, start() {}, stop() {} });
class Context {
  static made = [];
  constructor() {
    Object.assign(this, { sampleRate: 10, currentTime: 3, state: "running", oscillator: node(), gains: [] });
    Context.made.push(this);
  }
  createBuffer = () => ({ getChannelData: () => new Float32Array(10) });
  createBufferSource = node;
  createBiquadFilter = node;
  createOscillator = () => this.oscillator;
  createGain = () => this.gains[this.gains.push(node()) - 1];
  suspend = () => void (this.state = "suspended");
  resume = () => void (this.state = "running");
  close = () => void (this.state = "closed");
}

test("the hum is as high as the top turns fast and fades by itself; there is no sound unless it is wanted, and it stops with the clock", (t) => {
  globalThis.AudioContext = Context;
  t.after(() => {
    listening.on = false;
    delete globalThis.AudioContext;
  });
  const unit = 0.04, turns = (rate) => 2 * Math.PI * rate * unit, sound = new Sound(); // a turn a second
  const rows = times.map((time) => ({ t: time, com: [0, 0, 1], omega: [0, 0, turns(30 - 20 * time)], force: [0, 0, 1] }));
  sound.show({ unit, table: "ordinary", frames: { ordinary: motion(rows) } });
  sound.at(0, true);
  assert.equal(Context.made.length, 0);
  listening.on = true;
  sound.at(0, true);
  const [context] = Context.made, { oscillator, gains: [rubbing, humming] } = context;
  near(oscillator.frequency.value, 240, 1e-3); // 8 Hz for a turn a second
  sound.at(unit / 2, true);
  near(oscillator.frequency.value, 160, 1e-3);
  const [[loud], [silent, from]] = humming.gain.aims.slice(-2);
  assert.ok(loud > 0 && silent === 0 && from > 3 && rubbing.gain.aims.every(([value]) => value === 0));
  sound.at(unit / 2, false);
  assert.equal(context.state, "suspended");
  sound.at(unit / 2, true);
  assert.equal(context.state, "running");
  listening.on = false;
  sound.at(unit / 2, true);
  assert.equal(context.state, "closed");
});
