// A file that is no text is known by its beginning, and comes in pieces that the server accepts.
import assert from "node:assert/strict";
import { test } from "node:test";
import { isPacked, piecesOf } from "../../app/frontend/src/widgets/measured_file.js";

const blob = (...parts) => new Blob(parts);

test("a zip, workbooks and Tracker's files are known by their beginning, and tables are not", async () => {
  const packed = [blob(new Uint8Array([0x50, 0x4b, 3, 4, 0])), blob(new Uint8Array([0xd0, 0xcf, 0x11, 0xe0])), blob('<?xml version="1.0"?>'),
    blob("\ufeff<?xml ?>"), blob('<object class="org.x">')];
  for (const file of packed) assert.equal(await isPacked(file), true);
  for (const file of [blob(""), blob("PK,t\n1,2"), blob("t,tilt\n"), blob("# <?xml")]) assert.equal(await isPacked(file), false);
});

test("the pieces of a file are the file, and none is larger than a message", async () => {
  const bytes = Uint8Array.from({ length: 500_001 }, (_, i) => (i * 7919) % 256), pieces = [];
  for await (const piece of piecesOf(blob(bytes), 2e6)) pieces.push(piece);
  assert.deepEqual(pieces.map(([, at, count]) => [at, count]), [[0, 4], [1, 4], [2, 4], [3, 4]]);
  assert.ok(pieces.every(([text]) => text.length <= 200_000));
  assert.deepEqual(Buffer.concat(pieces.map(([text]) => Buffer.from(text, "base64"))), Buffer.from(bytes));
});

test("a file that is too large is not sent", async () => {
  const pieces = [];
  for await (const piece of piecesOf(blob("x".repeat(1000)), 999)) pieces.push(piece);
  assert.deepEqual(pieces, [["", 0, 1]]);
});
