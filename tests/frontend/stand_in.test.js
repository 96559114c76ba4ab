import assert from "node:assert/strict";
import { test } from "node:test";
import { numbersIn, standIn } from "../../app/frontend/src/stand_in.js";
import { near } from "./helping.js";

const file = (heads, ...numbers) => {
  const line = new TextEncoder().encode(`${JSON.stringify(heads)}\n`), bytes = new Uint8Array(new Float32Array(numbers).buffer);
  const all = new Uint8Array(line.length + bytes.length);
  all.set(line);
  all.set(bytes, line.length);
  return all.buffer;
};

test("arrays come column by column, and what is not in the file is zero", () => {
  const found = numbersIn(file([["frames", 3, 4, 2], ["profile", 1, 2, 2]], 1, 2, 3, 10, 20, 30, 7, 8));
  near([...new Float32Array(found.frames)], [1, 10, 0, 0, 2, 20, 0, 0, 3, 30, 0, 0]);
  near([...new Float32Array(found.profile)], [7, 8]);
});

test("what a hand did before reaches the session's model, which tells from then on what is new in it", () => {
  const heard = [], { model, become } = standIn(/** @type {any} */ ({ asked: [], state: { mu: 0.3 }, a: 1 }));
  for (const name of ["asked", "state", "a"]) model.on(name, () => heard.push(name));
  model.asked = [1, "spin", 30];
  const runs = {}, its = /** @type {any} */ ({ asked: [], state: { mu: 0.2 }, a: 1, on: (name, run) => (runs[name] = run) });
  become(its);
  assert.deepEqual(its.asked, [1, "spin", 30]);
  assert.deepEqual(heard, ["state"]); // the same number is no news
  assert.equal(model.state.mu, 0.2);
  its.state = { mu: 0.1 };
  runs.state();
  assert.deepEqual([heard, model.state.mu], [["state", "state"], 0.1]);
});
