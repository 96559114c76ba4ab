import assert from "node:assert/strict";
import { test } from "node:test";
import { Player } from "../../app/frontend/src/motion/player.js";
import { motion, near } from "./helping.js";

function playerOf(...times) {
  const heard = { changed: 0, landed: 0, playingChanged: 0 }, tell = Object.fromEntries(Object.keys(heard).map((name) => [name, () => (heard[name] += 1)]));
  const player = new Player(/** @type {any} */ (tell));
  player.setFrames(motion(times.map((t) => ({ t }))));
  return { player, heard };
}

test("a playing top follows the wall clock and starts again at the end", () => {
  const { player } = playerOf(1, 2, 5);
  player.seek(1);
  player.setPlaying(true);
  assert.equal(player.advance(1000, 0.01), false); // the clock starts here
  player.advance(1100, 0.01);
  near(player.t, 2);
  player.advance(1300, 0.01);
  near(player.t, 4);
  assert.equal(player.advance(1450, 0.01), true);
  near(player.t, 1.5);
  player.advance(9000, 0.01); // the page was suspended: at most a quarter of a second counts
  near(player.t, 4);
});

test("any time belongs to the motion, because it repeats", () => {
  const { player } = playerOf(1, 2, 5);
  for (const [t, within] of [[1, 1], [5, 5], [5.5, 1.5], [0.5, 4.5], [13.25, 1.25], [-7.5, 4.5]]) near(player.wrap(t), within);
  assert.equal(playerOf(3).player.wrap(8), 3);
});

test("steps go from row to row, and from the end to the start", () => {
  const { player, heard } = playerOf(1, 2, 5), seen = [];
  for (const by of [1, 1, 1, -1, -1]) {
    player.step(by);
    seen.push(player.t);
  }
  assert.deepEqual(seen, [2, 5, 1, 5, 2]);
  assert.equal(heard.landed, 5);
  player.show(99);
  assert.equal(player.t, 5);
});

test("a paused top is on a row, a playing one continues from where it is moved", () => {
  const { player, heard } = playerOf(1, 2, 5);
  player.seek(4);
  assert.deepEqual([player.t, player.index, heard.landed], [5, 2, 1]);
  player.setPlaying(true);
  player.seek(4);
  assert.deepEqual([player.t, player.index, heard.landed, heard.playingChanged], [4, 1, 1, 1]);
  player.setPlaying(true); // nothing has changed
  assert.equal(heard.playingChanged, 1);
  player.setPlaying(false);
  assert.deepEqual([player.t, heard.landed, heard.playingChanged], [5, 2, 2]);
});

test("while the time is held it does not advance, and then it continues without a jump", () => {
  const { player } = playerOf(1, 2, 5);
  player.setPlaying(true);
  player.advance(1000, 0.01);
  player.seek(3, true);
  assert.equal(player.advance(1100, 0.01), false);
  assert.equal(player.t, 3);
  player.seek(3, false);
  player.advance(1200, 0.01);
  assert.equal(player.t, 3);
  player.advance(1210, 0.01);
  near(player.t, 3.1);
  player.seek(2); // not held: the clock continues
  player.advance(1310, 0.01);
  near(player.t, 3);
});

test("a new motion keeps the time, and one that follows another player takes its time", () => {
  const { player } = playerOf(1, 2, 5);
  player.seek(5);
  player.setFrames(motion([0, 4.5, 7].map((t) => ({ t }))));
  assert.equal(player.t, 4.5);
  player.setPlaying(true);
  player.seek(5.5);
  player.setFrames(motion([0, 5].map((t) => ({ t }))));
  assert.equal(player.t, 0.5);
  assert.deepEqual([player.follow(3), player.t, player.follow(2), player.t], [false, 3, true, 2]);
});

// Played once, to a time that rounding has put a little beyond the last row, as seconds of the page are.
function oncePlayed(until, ...times) {
  const { player, heard } = playerOf(...times);
  player.until = () => until;
  return { player, heard };
}

test("a motion that is played once pauses at its end, by itself and wherever a person lets go of it", () => {
  const { player, heard } = oncePlayed(5 * (1 + 1e-7), 1, 2, 5);
  player.seek(4);
  assert.equal(player.t, 4); // between two rows
  player.seek(5);
  player.setPlaying(true);
  assert.deepEqual([player.t, player.playing], [1, true]); // at its end it starts again
  for (const now of [1000, 1200, 1400]) assert.equal(player.advance(now, 0.01), false);
  assert.deepEqual([player.t, player.playing], [5, false]);
  for (const [beyond, way] of [[5 * (1 + 1e-7), "the key End"], [9, "a pointer beyond the edge"]]) {
    player.setPlaying(true);
    assert.deepEqual([player.t, player.playing], [1, true], way);
    player.seek(beyond, true);
    assert.deepEqual([player.t, player.playing], [5, true], way); // while it is held
    assert.equal(player.advance(5000, 0.01), false);
    player.seek(beyond);
    assert.deepEqual([player.t, player.playing], [5, false], way);
  }
  player.setPlaying(true);
  player.seek(3);
  assert.deepEqual([player.t, player.playing], [3, true]);
  assert.equal(heard.playingChanged, 7);
});

test("it ends where its part ends, and a new motion that is over by then starts at its beginning", () => {
  const rows = Array.from({ length: 2001 }, (_, i) => i / 200), { player } = oncePlayed(4, ...rows);
  player.setPlaying(true);
  player.seek(3.9);
  for (const now of [0, 200]) player.advance(now, 0.001);
  assert.deepEqual([player.t, player.playing], [4, false]);
  player.until = () => Infinity;
  player.setPlaying(true);
  assert.equal(player.t, 4);
  player.setFrames(motion([0, 1, 3].map((t) => ({ t }))));
  assert.deepEqual([player.t, player.playing], [0, true]);
});

test("a top that follows another one does not stop it when its own motion is over", () => {
  const { player } = oncePlayed(5, 1, 2, 5);
  player.setPlaying(true);
  player.advance(0, 0);
  player.follow(8);
  player.advance(100, 0);
  assert.deepEqual([player.t, player.playing], [5, true]);
});

test("everything works without a motion", () => {
  const { player, heard } = playerOf();
  player.step(1);
  player.show(3);
  player.seek(2);
  assert.deepEqual([player.t, player.place, player.index, heard.landed], [0, 0, 0, 0]);
});
