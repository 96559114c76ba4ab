import assert from "node:assert/strict";
import { test } from "node:test";
import { trackOf } from "../../app/frontend/src/lab/answer.js";
import { Asking } from "../../app/frontend/src/controls/asking.js";
import { Before } from "../../app/frontend/src/lab/before.js";
import { keptAt } from "../../app/frontend/src/lab/keeps.js";
import { strengthOf } from "../../app/frontend/src/lab/launch.js";
import { Curves, latest, placed, tempo, ticks, TILT } from "../../app/frontend/src/motion/curves.js";
import { read, say, written } from "../../app/frontend/src/parts.js";
import { near } from "./helping.js";

const curves = (...rows) => new Curves(new Float32Array(rows.flatMap(([t, tilt]) => [t, tilt, 0, 0, 0, 0, 0, 0])).buffer);

test("a curve is linear between its rows, and constant beyond its ends", () => {
  const line = curves([0, 10], [1, 20], [3, 60]);
  near([-1, 0, 0.5, 1, 2, 3, 9].map((t) => line.at(t, TILT)), [10, 10, 15, 20, 40, 60, 60]);
  assert.equal(line.end, 3);
  near(line.range(TILT), [10, 60]);
  assert.equal(line.points((t) => 10 * t, (tilt) => -tilt, TILT), "0.0,-10.0 10.0,-20.0 30.0,-60.0");
});

test("an empty curve has no value and no end", () => {
  const none = new Curves(null);
  assert.ok(Number.isNaN(none.at(1, TILT)));
  assert.equal(none.end, 0);
  assert.equal(none.points(Number, Number, TILT), "");
});

test("the stage at a time is the last that has begun", () => {
  const stages = [[0, "rises"], [1, "over"], [1.5, "stands-on-stem"]];
  assert.deepEqual([0, 0.99, 1, 5].map((t) => latest(stages, t)[1]), ["rises", "rises", "over", "stands-on-stem"]);
  assert.equal(latest([], 1), undefined);
});

test("ticks are round numbers within the scale", () => {
  near(ticks(0, 6, 7), [0, 1, 2, 3, 4, 5, 6]);
  near(ticks(0, 5.9999, 7).at(-1), 6);
  near(ticks(0, 211, 4), [0, 100, 200]);
  near(ticks(-17, 31, 5), [-10, 0, 10, 20, 30]);
});

const LIFE = [[0.98, "over"], [1.37, "stem"], [1.47, "stands-on-stem"], [4.5, "falls"], [5.57, "off"], [7.26, "tips-back"], [9.22, "leans"], [9.96, "rolls"]];

test("it plays slowly until the top has turned over and stood for a moment, and always if nothing happens", () => {
  assert.deepEqual([0, 1.4, 2].map((t) => tempo(LIFE, t, 12)), [0.25, 0.25, 0.25]);
  assert.deepEqual([0, 6].map((t) => tempo([], t, 6)), [0.25, 0.25]);
  const watched = (end) => {
    let t = 0, found = 0;
    for (; t < end - 0.01; found += 0.01) t += 0.01 * tempo(LIFE, t, 12);
    return found;
  };
  assert.ok(watched(2) < 10, "the whole flip is seen within 10 s");
  assert.ok(watched(12) < 30, "and its life within half a minute");
});

test("it plays in real time or faster while nothing happens for long, and does not skip what happens", () => {
  assert.deepEqual([2.5, 4.4, 4.6, 5.6, 7].map((t) => tempo(LIFE, t, 12)), [1, 0.5, 0.5, 0.5, 0.5]);
  const long = [[1.4, "over"], [2.2, "stands-on-stem"], [25, "falls"]];
  assert.deepEqual([2.7, 3, 24.6, 24.8].map((t) => tempo(long, t, 27)), [0.25, 8, 8, 0.5]);
  assert.deepEqual([1, 3, 8, 9].map((t) => tempo([[8, "rolls"]], t, 10)), [0.25, 2, 0.5, 1]);
});

test("the words of events are placed where there is room, short where there is little, and never overlap", () => {
  const wide = (word) => 6 * word.length;
  const [over, stands, falls] = placed([[120, "turns over 1.0 s", "over 1.0 s"], [170, "stands 1.5 s", "stands 1.5 s"], [500, "starts to fall 4.5 s", "falls 4.5 s"]], 0, 580, wide);
  assert.deepEqual([over.word, over.side], ["turns over 1.0 s", "end"]);
  assert.deepEqual([stands.word, stands.side], ["stands 1.5 s", "start"]);
  assert.deepEqual([falls.word, falls.side], ["starts to fall 4.5 s", "end"]);
  const two = placed([[80, "stands 1.5 s", "stands 1.5 s"], [187, "falls 4.5 s", "falls 4.5 s"], [224, "off its stem 5.6 s", "off its stem 5.6 s"]], 0, 340, wide);
  assert.deepEqual(two.map(({ side, row }) => [side, row]), [["start", 0], ["end", 1], ["start", 0]]); // a second row if one has no room
  const phone = [[64, "over 1.0 s"], [77, "stands 1.5 s"], [154, "falls 4.5 s"], [229, "tips back 7.3 s"], [304, "rolls 10.0 s"]].map(([x, word]) => [x, word, word]);
  const wording = placed(phone, -6, 358, wide).map(({ word }) => word);
  assert.ok(["over 1.0 s", "stands 1.5 s", "falls 4.5 s"].every((word) => wording.includes(word))); // what it is for comes first
  assert.equal(placed([[5, "a long word", "short one"], [9, "a long word", "short one"], [13, "a long word", "short one"]], 0, 20, wide).length, 0);
});

test("numbers are written and read in the page's language", () => {
  assert.equal(written(-15.34, 1, ","), "−15,3");
  assert.equal(written(-0.04, 1, "."), "0.0");
  near([" 28,65 ", "28.65", "−3"].map(read), [28.65, 28.65, -3]);
  assert.ok([read(""), read("half"), read("1.2.3")].every(Number.isNaN));
  assert.equal(say({ decimal: "," }, "{t} s, {what}", { t: [2.5, 2], what: "leans" }), "2,50 s, leans");
});

test("one request at a time is sent, the newest of each input waits, and none is lost", () => {
  const sent = [], asking = new Asking((...wish) => sent.push(wish));
  asking.ask("spin", 1);
  asking.ask("spin", 2);
  asking.ask("tilt", 5);
  asking.ask("spin", 3);
  assert.deepEqual(sent, [[1, "spin", 1]]);
  assert.ok(asking.isAhead);
  asking.hear(1);
  assert.deepEqual(sent.at(-1), [2, "tilt", 5]);
  asking.hear(2);
  assert.deepEqual(sent.at(-1), [3, "spin", 3]);
  asking.hear(2); // an old answer
  assert.ok(asking.isAhead);
  asking.hear(3);
  assert.ok(!asking.isAhead);
  assert.equal(sent.length, 3);
});

test("the track is the contact of each frame, in seconds and R", () => {
  const rows = [[2, 0, 0, 0, 1, 0.5, -0.25], [4, 0, 0, 0, 1, 0.75, 1]].map((row) => [...row, ...Array(21 - row.length).fill(0)]);
  assert.deepEqual(trackOf(new Float32Array(rows.flat()).buffer, 0.5), [[1, 0.5, -0.25], [2, 0.75, 1]]);
});

const BEFORE = { inputs: { spin: { name: "Spin" }, mu: { name: "Friction" } }, toy: "Top", decimal: ".",
  changed: "{name}: {from} → {to}", compared: "{changed}. Before: {before}." };
const scene = (spin, mu, events, table = "ordinary") => ({ table, runs: {}, run: { events, stages: [[0, "", "", "Nods"]], why: "" },
  state: { of: { spin: [spin, `Spin ${spin}.0 rev/s`], mu: [mu, `Friction ${mu}`], table: [table, `Table ${table}`, "Table"] }, runs: {} } });

test("the earlier run is the one before the gesture, until it is dismissed or restored, also on another table", () => {
  const before = new Before(BEFORE), stands = [[1, "over", "turns over", ""], [1.5, "stands-on-stem", "stands on its stem", ""]];
  const slow = scene(20, 0.3, []), middle = scene(24, 0.3, []), fast = scene(28, 0.3, stands);
  assert.equal(before.follow(null, slow), null);
  before.touch("spin", slow, 0, 0);
  assert.equal(before.follow(slow, middle).what, "Spin 20.0 rev/s");
  before.touch("spin", middle, 0, 500); // the same gesture
  const found = before.follow(middle, fast);
  assert.equal(found.compared, "Spin: 20.0 rev/s → 28.0 rev/s. Before: Nods.");
  const request = [];
  before.goBack((...wish) => request.push(wish), fast);
  assert.deepEqual(request, [["spin", 20]]);
  assert.equal(before.follow(fast, slow), null); // no person changed that
  before.follow(slow, fast);
  before.touch("mu", fast, 0, 9000);
  assert.equal(before.follow(fast, scene(28, 0.1, stands)).what, "Friction 0.3");
  assert.equal(before.follow(scene(28, 0.1, stands), fast), null); // as it was
  before.touch("spin", fast, 0, 20000);
  before.follow(fast, slow);
  before.forget();
  assert.equal(before.follow(slow, slow), null);
  before.follow(slow, fast);
  const rough = before.follow(fast, scene(28, 0.3, [], "rough"));
  assert.equal(rough.what, "Table ordinary");
  assert.equal(rough.compared, ""); // the stage says what another table does
  assert.equal(rough.table, "ordinary");
  assert.equal(before.follow(scene(28, 0.3, [], "rough"), scene(28, 0.3, [], "three")), null);
});

test("what changes elsewhere is compared with the run that was shown here; undo leads back to the earlier one", () => {
  const before = new Before(BEFORE), first = scene(28, 0.3, []), slippery = scene(28, 0.12, []);
  before.touch("mu", first, 0, 0);
  assert.equal(before.follow(first, slippery, true).what, "Friction 0.3");
  assert.equal(before.follow(slippery, slippery, true).what, "Friction 0.3"); // another room, and back
  assert.equal(before.follow(slippery, scene(28, 0.2, []), true).what, "Friction 0.12"); // set in another room
  assert.equal(before.follow(scene(28, 0.2, []), scene(28, 0.2, [], "rough"), true).what, "Table ordinary");
  before.touch("mu", first, 0, 9000);
  before.follow(first, slippery, true);
  assert.equal(before.follow(slippery, first, true), null); // undo
});

test("one press makes one change, however long it lasts; the next press makes another", () => {
  const before = new Before(BEFORE), [first, second, third, last] = [20, 24, 28, 30].map((spin) => scene(spin, 0.3, []));
  before.touch("spin", first, 1, 0);
  before.follow(first, second);
  before.touch("spin", second, 1, 60_000);
  assert.equal(before.follow(second, third).what, "Spin 20.0 rev/s");
  before.touch("spin", third, 2, 60_100);
  assert.equal(before.follow(third, last).what, "Spin 28.0 rev/s");
});

test("a press has no strength, a longer hold has more, up to the greatest", () => {
  assert.deepEqual([0, 299, 300, 1300, 2300, 9000].map(strengthOf), [null, null, 0, 0.5, 1, 1]);
});

test("what is conserved is told to the present moment, with as many digits as tell two numbers apart", () => {
  const keep = { kept: "kept", swings: "swings", nearly: "nearly", zero: "zero", lost: "lost", heat: "heat", reversed: "reversed", one: "{first}{unit}", two: "{first} → {last}{unit}", range: "{first} – {last}{unit}", units: [" mm", "", "", " rev/s"] };
  const texts = { decimal: ",", keep }, rows = new Float32Array([
    0, 0, 205, 205, 0, 4.9, 4.9, 0, 7.32, 7.32, 0, 28.6, 28.6,
    1.3, 4, 205, 103, 2, 4.9, 4.84, 3, 7.32, -4.5, 3, 28.6, -14,
    6, 4, 205, 21, 4, 4.9, 1.06, 1, 7.31, 7.3134, 0, 28.6, 28.6,
  ]);
  const wording = (t) => keptAt(rows, t, texts).map(([, ...words]) => words.join(" "));
  assert.deepEqual(wording(1.29), ["kept 205 mm", "kept 4,90", "kept 7,32", "kept 28,6 rev/s"]);
  for (const t of [1.3, 5.99]) assert.deepEqual(wording(t), ["heat 205 → 103 mm", "nearly 4,90 → 4,84", "zero 7,32 → −4,50", "reversed 28,6 → −14,0 rev/s"]);
  assert.deepEqual(wording(6), ["heat 205 → 21 mm", "lost 4,90 → 1,06", "swings 7,310 – 7,313", "kept 28,6 rev/s"]);
  assert.deepEqual(keptAt(rows.subarray(0, 13), 0, texts).map(([kind]) => kind), ["kept", "kept", "kept", "kept"]);
});
