import assert from "node:assert/strict";
import test from "node:test";
import { finder, readoutOf } from "../../app/frontend/src/widgets/terms.js";

const TERMS = {
  precession: { forms: "precession", is: "the axis goes round" },
  steady: { forms: "steady precession|steady precessions", is: "the tilt stays" },
  angle: { forms: "tilt|tilts", is: "the angle" },
  chi: { forms: "χ²|chi-square", is: "a sum" },
  lift: { forms: "Abheben|hebt ab", is: "…" },
};
const names = (text) => finder(TERMS)(text).map(({ name, at, end }) => [name, text.slice(at, end)]);

test("a term is found as a whole word, in any of its forms, longest first", () => {
  assert.deepEqual(names("Tilts of a steady precession, and precession."), [["angle", "Tilts"], ["steady", "steady precession"], ["precession", "precession"]]);
  assert.deepEqual(names("tilted, overtilt, tilt-rate, precessions"), []);
  assert.deepEqual(names("χ² of it; er hebt ab."), [["chi", "χ²"], ["lift", "hebt ab"]]);
  assert.deepEqual(names(""), []);
});

test("a term that is also a symbol has its sketch", () => {
  assert.match(readoutOf(TERMS, "angle"), /^<svg.*<b>tilt<\/b>: the angle\.<\/div>$/);
  assert.equal(readoutOf(TERMS, "steady"), "<div><b>steady precession</b>: the tilt stays.</div>");
});
