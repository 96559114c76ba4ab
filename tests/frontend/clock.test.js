import assert from "node:assert/strict";
import { test } from "node:test";
import { motion, near } from "./helping.js";

const window = (globalThis.window = new EventTarget());
let still = false; // whether the system asks for reduced motion
globalThis.matchMedia = () => ({ matches: still });
const { photosOf, Place, timeOf } = await import("../../app/frontend/src/motion/clock.js");

function topOn(clock, { inView = true, wide = 1, rows = [0, 1, 2, 4], ...more } = {}) {
  const listeners = {}, model = {
    clock, frames: motion(rows.map((t) => ({ t }))), time: 0, playing: false, speed: 0.5, seconds: 0.02,
    on: (name, run) => (listeners[name] = run), ...more,
  };
  const life = new AbortController();
  const place = new Place({ model, picture: { clientWidth: wide }, life: life.signal, changed() {}, inView: () => inView, photo: (pixels) => `${clock} ${pixels}`, report: () => ({}) });
  place.take();
  place.begin();
  return { place, model, player: place.player, leave: () => life.abort(), told: (name, value) => listeners[name]((model[name] = value)) };
}

// Runs a test with this many tops on one clock, and removes them afterwards.
function together(tops, run) {
  try {
    run(...tops);
  } finally {
    for (const { leave } of tops) leave();
  }
}

test("tops of one clock play, stop and move together; others do not", () =>
  together([topOn("a"), topOn("a"), topOn("b"), topOn(""), topOn("")], (one, two, other, alone, beside) => {
    one.player.setPlaying(true);
    assert.deepEqual([two, other, alone].map(({ model }) => model.playing), [true, false, false]);
    two.player.setPlaying(false);
    assert.equal(one.model.playing, false);
    one.player.step(2);
    assert.deepEqual([one, two, other].map(({ player }) => player.t), [2, 2, 0]);
    one.place.take(true); // a new motion that starts from its beginning affects only this top
    assert.deepEqual([one, two].map(({ player }) => player.t), [0, 2]);
    one.leave();
    assert.equal(timeOf("a"), 2);
    two.player.step(-1);
    assert.deepEqual([one, two].map(({ player }) => player.t), [0, 1]);
    alone.player.step(1);
    assert.deepEqual([alone, beside].map(({ player }) => player.t), [1, 0]);
  }));

test("a top that joins later takes the time of the others", () =>
  together([topOn("a", { playing: true, time: 1 })], (first) => {
    assert.deepEqual([first.player.t, first.player.playing], [1, true]);
    const second = topOn("a");
    assert.deepEqual([second.player.t, second.model.playing], [1, true]);
    second.leave();
  }));

test("the first visible top that has a motion moves the time, at the model's speed", () =>
  together([topOn("a", { rows: [0] }), topOn("a", { inView: false }), topOn("a"), topOn("a")], (...tops) => {
    const [, , leader, last] = tops;
    assert.deepEqual(tops.map(({ place }) => place.leads), [false, false, true, false]);
    leader.player.setPlaying(true);
    const pass = (now) => [leader, last].map(({ place }) => place.advance(now));
    for (const now of [0, 40]) assert.deepEqual(pass(now), [false, false]);
    near([leader.player.t, last.player.t], [1, 1]); // 40 ms at half speed are 20 ms of the real top, one unit
    assert.deepEqual([leader, tops[0]].map(({ place }) => place.moves), [true, false]);
    assert.deepEqual(pass(180), [true, true]); // both start again
    near([leader.player.t, last.player.t], [0.5, 0.5]);
    assert.equal(timeOf("a"), leader.player.t);
    assert.deepEqual(photosOf(6).map(({ picture }) => picture), ["a 2", "a 2", "a 2"]); // of the visible ones
    near(photosOf(6).at(-1).seconds, leader.player.t * leader.model.seconds);
    assert.equal(timeOf("nobody's"), 0);
  }));

test("each moment is announced once, by the top that moves the time; a seek moves it", () =>
  together([topOn("a"), topOn("a")], (one, two) => {
    const heard = [], listen = ({ detail }) => heard.push(detail);
    window.addEventListener("tippe:clock:a", listen);
    window.dispatchEvent(new CustomEvent("tippe:seek:a", { detail: { t: 2 } }));
    for (const { place } of [one, two, one]) place.say("rolls");
    assert.deepEqual(heard, [{ t: 2, index: 2, playing: false, verdict: "rolls" }]);
    assert.equal(two.player.t, 2);
    window.removeEventListener("tippe:clock:a", listen);
  }));

test("a new motion is announced although its moment is the same", () =>
  together([topOn("a")], ({ place, model }) => {
    const heard = [], listen = ({ detail }) => heard.push(detail.t);
    window.addEventListener("tippe:clock:a", listen);
    place.say("rolls");
    place.say("rolls");
    model.frames = motion([0, 3].map((t) => ({ t })));
    place.take();
    place.say("rolls");
    assert.deepEqual(heard, [0, 0]);
    window.removeEventListener("tippe:clock:a", listen);
  }));

test("the keys of the page reach the visible top", () =>
  together([topOn("", { wide: 0 }), topOn("")], (hidden, { player }) => {
    const command = (detail) => window.dispatchEvent(new CustomEvent("tippe:command", { detail }));
    command({ step: 1 });
    assert.equal(player.t, 1);
    command({ toggle: true });
    assert.deepEqual([player.playing, hidden.player.playing, hidden.player.t], [true, false, 0]);
  }));

test("Python gets the time at which it was released, and its echo moves nothing", ({ mock }) => {
  mock.timers.enable({ apis: ["setTimeout"] });
  together([topOn("a")], ({ player, model, told }) => {
    player.step(1);
    player.step(1);
    assert.equal(model.time, 0);
    mock.timers.tick(1000);
    assert.equal(model.time, 2);
    player.seek(1, true);
    told("time", player.t + 1e-12);
    assert.deepEqual([player.t, player.held], [1, true]);
    told("time", 3.6);
    assert.deepEqual([player.t, player.held], [4, false]);
    player.seek(1, true);
    mock.timers.tick(1000); // not while it is held
    assert.equal(model.time, 3.6);
  });
});

test("with reduced motion nothing plays by itself", () => {
  still = true;
  together([topOn("a", { playing: true })], ({ player, model }) => assert.deepEqual([player.playing, model.playing], [false, false]));
  still = false;
});
