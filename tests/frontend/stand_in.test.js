import assert from "node:assert/strict";
import { test } from "node:test";
import { numbersIn, standIn } from "../../app/frontend/src/stand_in.js";
import { near } from "./helping.js";

const file = (heads, ...numbers) => {
  const line = new TextEncoder().encode(`${JSON.stringify(heads)}\n`), bytes = new Uint8Array(new Int32Array(numbers).buffer);
  const all = new Uint8Array(line.length + bytes.length);
  all.set(line);
  all.set(bytes, line.length);
  return all.buffer;
};

test("arrays are stored column by column as second differences of steps, and missing columns are zero", () => {
  const found = numbersIn(file([["frames", 3, 4, 2, 2], ["profile", 1, 2, 2, 1]], 2, 0, 0, 20, -20, 5, 7, 8));
  near([...new Float32Array(found.frames)], [1, 10, 0, 0, 2, 10, 0, 0, 3, 12.5, 0, 0]);
  near([...new Float32Array(found.profile)], [7, 8]);
});

test("earlier changes reach the session's model, which from then on announces its own", () => {
  const heard = [], { model, become } = standIn(/** @type {any} */ ({ request: [], state: { mu: 0.3 }, a: 1 }));
  for (const name of ["request", "state", "a"]) model.on(name, () => heard.push(name));
  model.request = [1, "spin", 30];
  const runs = {}, its = /** @type {any} */ ({ request: [], state: { mu: 0.2 }, a: 1, on: (name, run) => (runs[name] = run) });
  become(its);
  assert.deepEqual(its.request, [1, "spin", 30]);
  assert.deepEqual(heard, ["state"]); // an equal number is no change
  assert.equal(model.state.mu, 0.2);
  its.state = { mu: 0.1 };
  runs.state();
  assert.deepEqual([heard, model.state.mu], [["state", "state"], 0.1]);
});
