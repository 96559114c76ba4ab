import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { sketchOf } from "../../app/frontend/src/widgets/sketches.js";
import { symbolOf } from "../../app/frontend/src/widgets/symbols.js";

// The parts that are needed of the elements of <i>K</i><sub>J</sub>.
function symbol(letter, below) {
  const i = { nodeName: "I", textContent: letter, matches: (tag) => tag === "i", nextSibling: null };
  const sub = { nodeName: "SUB", textContent: below, matches: (tag) => tag === "sub", previousSibling: i, previousElementSibling: i };
  if (below) i.nextSibling = sub;
  return { i, sub };
}

test("a symbol is recognised by its letter and its subscript", () => {
  const K_J = symbol("K", "J"), tilt = symbol("θ"), word = symbol("toy");
  assert.equal(symbolOf(K_J.i), "K_J");
  assert.equal(symbolOf(K_J.sub), "K_J");
  assert.equal(symbolOf(tilt.i), "angle");
  assert.equal(symbolOf(symbol("ω", "3").sub), "omega3");
  assert.equal(symbolOf(word.i), undefined);
  assert.equal(symbolOf({ matches: () => false }), undefined);
});

test("every symbol with an explanation has a sketch", () => {
  const text = readFileSync(new URL("../../app/text/en/controls.toml", import.meta.url), "utf8");
  const [, hints] = text.split("[hints]\n"), others = hints.split("\n[")[0].matchAll(/^(\w+) = /gm);
  const names = [...others, ...text.matchAll(/^\[inputs\.(\w+)\]/gm)].map(([, name]) => name);
  assert.ok(names.length > 20);
  for (const name of names) assert.match(sketchOf(name) ?? name, /^<svg/);
});
