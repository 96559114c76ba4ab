import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const packageAt = (path) => JSON.parse(readFileSync(new URL(path, import.meta.url), "utf8"));

test("the tests use the three.js of the bundle", () => {
  const { three } = packageAt("../../app/frontend/package.json").dependencies, ours = packageAt("package.json").devDependencies;
  assert.equal(ours.three, three);
  assert.equal(ours["@types/three"].split(".")[1], three.split(".")[1]); // the patch number of the types is independent
});
