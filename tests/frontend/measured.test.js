// A table is thinned in the browser, and a large one read piece by piece; a ghost shows where a film saw the axis.
import assert from "node:assert/strict";
import { test } from "node:test";
import { rowAt } from "../../app/frontend/src/three/measured.js";
import { encodingOf, readFile, sizeOf, thinned } from "../../app/frontend/src/widgets/measured_file.js";

const LIMITS = { most: 10_000, rows: 5000, head: 12 };
const table = (rows, end = "\n") => ["# a film", "t (s)\ttilt (°)", ...Array.from({ length: rows }, (_, i) => `${(i / 240).toFixed(4)}\t${i}`)].join(end);

test("a measured axis is shown only between frames that show it", () => {
  const rows = new Float32Array([0, 1, 2, 9, 10].flatMap((t) => [t, 0, 0, 1]));
  assert.deepEqual(rowAt(rows, 1.25), [1, 0.25]);
  assert.deepEqual(rowAt(rows, 0), [0, 0]);
  assert.deepEqual(rowAt(rows, 10.5), [3, 1]); // half a frame after the last
  assert.equal(rowAt(rows, 13), null);
  assert.equal(rowAt(rows, -3), null);
  assert.deepEqual(rowAt(rows, 5), [2, 3 / 7]);
  const gap = new Float32Array([0, 1, 2, 3, 4, 5, 16, 17, 18].flatMap((t) => [t, 0, 0, 1]));
  assert.equal(rowAt(gap, 10), null); // nothing was measured there
  assert.equal(rowAt(rows.subarray(0, 4), 0), null);
});

test("a table of short rows is thinned to the permitted number of rows", () => {
  const rows = (count) => ["t,tilt", ...Array.from({ length: count }, (_, i) => `${i},1`), ""].join("\n");
  assert.deepEqual(thinned(rows(5000), { ...LIMITS, most: 100_000 }), [rows(5000), 1]);
  for (const count of [5100, 12_345, 100_000]) {
    const [text, each] = thinned(rows(count), { ...LIMITS, most: 100_000 }), kept = text.split("\n").length;
    assert.ok(kept <= LIMITS.rows && kept > LIMITS.rows / 2 - 20 && each >= Math.floor(count / LIMITS.rows), `${count}: ${kept}`);
  }
});

test("a short table is left as it is", () => assert.deepEqual(thinned(table(20), LIMITS), [table(20), 1]));

test("of a long table every n-th row is kept, and the names", () => {
  const [text, each] = thinned(table(5000), LIMITS), lines = text.split("\n");
  assert.ok(each > 1 && text.length <= LIMITS.most);
  assert.equal(lines[1], "t (s)\ttilt (°)");
  const last = lines.slice(20).map((line) => Number(line.split("\t")[1]));
  last.slice(1).forEach((row, i) => assert.equal(row - last[i], each));
});

// Numbers that are the same in each run of the tests.
function chance(seed) {
  let state = seed;
  const next = (low, high) => {
    state = (state * 48271) % 2147483647;
    return low + (state % (high - low + 1));
  };
  return next;
}

// A table of these many lines, each with a number of cells between two: short or long lines, and letters that take more
// room in a message than here.
function shaped(next) {
  const [lines, cells] = [[next(1, 20), next(1, 2000)], [next(1, 600), next(1, 20)], [next(20, 60), next(100, 400)]][next(0, 2)];
  const between = ["\t", ",", '"\t"', " ; "][next(0, 3)], cell = ["1", "0,125", "2.123456789012", "µ°", '"\\"', "\u0001"][next(0, 5)], same = next(0, 1);
  return Array.from({ length: lines }, () => Array(same ? cells : next(1, cells)).fill(cell).join(between)).join("\n");
}

test("whatever the shape of a table, no more is sent than the server takes", async () => {
  const next = chance(7), seen = { whole: 0, thinned: 0, refused: 0 };
  for (let i = 0; i < 200; i += 1) {
    const text = shaped(next), file = new Blob([text]);
    for (const [kept, each] of [thinned(text, LIMITS), await readFile(file, LIMITS, () => {})]) {
      const message = JSON.stringify({ events: [{ kind: "ModelChanged", attr: "table", new: [kept, each, 1] }] });
      assert.ok(Buffer.byteLength(message) <= LIMITS.most + 100, `${i}: ${Buffer.byteLength(message)}`);
      seen[each === 1 ? "whole" : each ? "thinned" : "refused"] += 1;
      if (!each) assert.ok(kept === "" && sizeOf(text) > LIMITS.most, `${i}: refused without need`);
      if (each === 1) assert.equal(kept.split("\n").length, text.split("\n").length);
    }
  }
  assert.ok(Math.min(...Object.values(seen)) > 20, JSON.stringify(seen));
});

test("a table whose lines are too long is not sent", async () => {
  const names = Array.from({ length: 2000 }, (_, i) => `t${i}`).join(","), wide = [names, names, names].join("\n");
  assert.deepEqual(thinned(wide, LIMITS), ["", 0]);
  const two = new Blob([`${"1,".repeat(2_000_000)}\n${"2,".repeat(2_000_000)}`]);
  assert.deepEqual(await readFile(two, LIMITS, () => {}), ["", 0]);
});

test("lines that differ in length are thinned until they fit", () => {
  const lines = Array.from({ length: 600 }, (_, i) => (i % 7 ? "1,2" : "1,2,".repeat(40))), [text, each] = thinned(lines.join("\n"), LIMITS);
  assert.ok(each > 1 && sizeOf(text) <= LIMITS.most);
  text.split("\n").slice(LIMITS.head).forEach((line, i) => assert.equal(line, lines[each * (Math.ceil(LIMITS.head / each) + i)]));
});

test("superfluous digits are removed first", () => {
  const long = Array.from({ length: 400 }, (_, i) => `${i}.123456789012345,2.5E-3`).join("\n");
  const [text, each] = thinned(long, LIMITS);
  assert.equal(each, 1);
  assert.equal(text.split("\n")[399], "399.1234567,2.5E-3");
});

test("the encoding of a file is recognised from its beginning", () => {
  assert.equal(encodingOf(new TextEncoder().encode("t\ttilt (°)\n0\t1\n")), "utf-8");
  assert.equal(encodingOf(new Uint8Array([0xff, 0xfe, 0x74, 0])), "utf-16le");
  assert.equal(encodingOf(new Uint8Array([0x74, 0xb0, 0x74, 0x74, 0x74, 0x74])), "windows-1252");
});

// A file larger than one piece, which is never completely in memory here either.
function large(size, end) {
  const row = (i) => `${(i / 1000).toFixed(6).padStart(12, "0")}\t${String(i).padStart(9, "0")}${end}`, long = row(0).length;
  const head = `t (s)\tµ count${end}`, bytes = new TextEncoder().encode(head).length;
  return {
    size: bytes + size * long,
    slice(from, to) {
      const first = Math.max(Math.floor((from - bytes) / long), 0), last = Math.min(Math.ceil((to - bytes) / long), size);
      const rows = Array.from({ length: Math.max(last - first, 0) }, (_, i) => row(first + i)).join("");
      const all = new TextEncoder().encode((from < bytes ? head : "") + rows), at = from < bytes ? 0 : bytes + first * long;
      return new Blob([all.slice(from - at, to - at)]);
    },
  };
}

for (const end of ["\n", "\r\n"]) {
  test(`a large file is read piece by piece (${JSON.stringify(end)})`, async () => {
    const shares = [];
    const [text, each] = await readFile(/** @type {any} */ (large(250_000, end)), LIMITS, (share) => shares.push(share));
    const rows = text.split("\n").filter(Boolean), counts = rows.slice(20).map((row) => Number(row.split("\t")[1]));
    assert.ok(shares.length > 1 && shares.at(-1) === 1);
    assert.ok(text.length <= LIMITS.most && counts.length > 100);
    assert.equal(rows[0], "t (s)\tµ count");
    // a row's number in the file is its count and one; Python says a line by this, app/model/measured/table.py
    const after = text.split("\n").slice(LIMITS.head).filter(Boolean).map((row) => Number(row.split("\t")[1]) + 1);
    after.forEach((number, i) => assert.equal(number, each * (Math.ceil(LIMITS.head / each) + i)));
  });
}

test("of a file that is not text only the beginning is sent, for which there is an error message", async () => {
  const film = new Blob([new Uint8Array(5_000_000).fill(0).map((_, i) => i % 251)]);
  const [text, each] = await readFile(film, LIMITS, () => {});
  assert.ok(text.includes("\0") && text.length < LIMITS.most);
  assert.equal(each, 1);
});
