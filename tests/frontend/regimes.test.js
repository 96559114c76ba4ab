import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { colours, onDark } from "../../app/frontend/src/colours.js";
import { endColours, endRules } from "../../app/frontend/src/ends.js";
import { colourOf, nameOf, ROLLS, wordOf } from "../../app/frontend/src/regimes.js";

const listed = (name) => JSON.parse(readFileSync(new URL(`../../app/model/${name}.json`, import.meta.url), "utf8"));

test("the browser uses the common list of regimes", () => {
  const regimes = listed("regimes");
  assert.deepEqual(regimes.map((_, code) => nameOf(code)), regimes.map(({ name }) => name));
  assert.deepEqual(regimes.map((_, code) => colourOf(code)), regimes.map(({ colour }) => colours[colour]));
  assert.equal(nameOf(ROLLS), "rolls");
});

test("a regime is named in the words of a picture", () => {
  assert.equal(wordOf(ROLLS, { rolls: "it rolls" }), "it rolls");
});

test("the browser uses the common list of colours", () => {
  const { on_dark, ...all } = listed("colours");
  assert.deepEqual(colours, all);
  assert.deepEqual(onDark, { ...all, ...on_dark });
});

test("the browser uses the common list of ends", () => {
  const inLab = listed("ends").filter((end) => end.in_lab);
  for (const { in_lab: name, colour, on_dark } of inLab) {
    assert.equal(endColours(false)[`--end-${name}`], colour);
    assert.equal(endColours(true)[`--end-${name}`], on_dark);
    assert.ok(endRules.includes(`.end.${name} { background: var(--end-${name}); }`));
  }
});
