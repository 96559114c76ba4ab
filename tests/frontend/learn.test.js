import assert from "node:assert/strict";
import { test } from "node:test";
import { apart } from "../../app/frontend/src/learn/graph.js";
import { wishOf } from "../../app/frontend/src/learn/present.js";
import { verdictOf } from "../../app/frontend/src/learn/question.js";
import { arrow } from "../../app/frontend/src/learn/ways.js";

test("a guess is right or wrong, and “not sure” is neither", () => {
  const asks = { options: [["over", ""], ["falls", ""], ["unsure", ""]], unsure: "unsure" };
  assert.deepEqual(["over", "falls", "unsure"].map((guess) => verdictOf(asks, "over", guess)), ["right", "off", "unsure"]);
});

test("a number is right within a tolerance, close within three times that, and never right if there is no such value", () => {
  const asks = { low: 0, high: 180, step: 0.5, near: 3 };
  assert.deepEqual([60, 63, 57, 69, 70].map((guess) => verdictOf(asks, 60, guess)), ["right", "right", "right", "near", "off"]);
  assert.equal(verdictOf(asks, null, 60), "never");
  assert.equal(verdictOf(asks, 60, NaN), "unsure"); // nobody guessed
});

test("words that would overlap are pushed apart, and stay within the picture", () => {
  const words = [{ y: 50, of: "b" }, { y: 45, of: "a" }, { y: 200, of: "c" }];
  apart(words, 10, 100);
  const [b, a, c] = words.map(({ y }) => y);
  assert.ok(b - a >= 15 && c <= 100 && c - b >= 15);
});

test("keys control the class only while presenting, letters only with Alt, and none with Ctrl", () => {
  const press = (key, presenting, more = {}) => wishOf(/** @type {any} */ ({ key, code: "", ctrlKey: false, metaKey: false, altKey: false, ...more }), presenting);
  const alt = (code, presenting, more = {}) => press("x", presenting, { code, altKey: true, ...more });
  assert.deepEqual(["KeyP", "KeyR", "Digit0"].map((code) => alt(code, false)), ["present", "", ""]);
  assert.deepEqual(["KeyP", "KeyR", "Digit0", "KeyX"].map((code) => alt(code, true)), ["leave", "reveal", "reset", ""]);
  assert.deepEqual(["ArrowLeft", "ArrowRight", " ", "Escape"].map((key) => press(key, true)), ["back", "on", "play", "leave"]);
  for (const presenting of [true, false]) {
    for (const key of "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789?,.") assert.equal(press(key, presenting), "");
    for (const code of ["KeyP", "KeyR"]) assert.equal(alt(code, presenting, { ctrlKey: true }), "", "VoiceOver's");
  }
});

test("an arrow is as long as the rotation is fast, counterclockwise if positive, and absent at rest", () => {
  const end = (share) => arrow(share).line.split(" ").slice(-2).map((value) => Number(value) + 0);
  assert.deepEqual(arrow(0), { line: "", head: "" });
  assert.deepEqual(end(0.3), [-24, 0]); // a quarter turn, to the left
  assert.deepEqual(end(-0.3), [24, 0]);
  assert.deepEqual(end(2), end(1)); // never a full circle
});
