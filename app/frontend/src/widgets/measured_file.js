// A table that a person chooses, drops anywhere on the page, or pastes. It is read here, and rows are left out if it is
// too long; a saved film is a short text and is kept whole. A zip, a workbook or a file of Tracker's own is sent whole.
import { fill } from "../data.js";
import { lifeOf } from "../life.js";
import { part } from "../parts.js";

const STYLE = `
  .row { display: flex; flex-wrap: wrap; gap: 8px; align-items: center; font: calc(14px * var(--type, 1))/1.4 var(--family, system-ui, sans-serif); color: var(--ink) }
  label { display: inline-flex; align-items: center; min-height: 40px; padding: 0 20px; border-radius: 6px; font-weight: 600; cursor: pointer;
    background: var(--ink); color: var(--card); white-space: nowrap }
  label:focus-within { outline: 3px solid var(--focus); outline-offset: 2px }
  input { position: absolute; opacity: 0; width: 1px; height: 1px }
  textarea { flex: 1 1 calc(168px * var(--type, 1)); min-width: 0; height: calc(40px * var(--type, 1)); font: inherit; color: inherit; background: transparent; resize: none;
    border: 1px solid var(--control-line); border-radius: 6px; padding: 9px 10px; box-sizing: border-box }
  .says { flex: 1 0 100%; color: var(--faint); font-size: calc(12px * var(--type, 1)) } .says:empty { display: none }
  .over { position: fixed; inset: 0; z-index: 9990; display: grid; place-items: center; background: color-mix(in srgb, var(--accent) 15%, transparent); pointer-events: none;
    border: 3px dashed var(--focus); box-sizing: border-box; font: 600 calc(18px * var(--type, 1)) var(--family, system-ui, sans-serif); color: var(--ink) }
  .over b { background: var(--card); padding: 12px 20px; border-radius: 8px } [hidden] { display: none !important }
  `;
const KINDS = ".csv,.tsv,.txt,.json,.zip,.xlsx,.xlsm,.xls,.ods,.trk,.trz,text/*";
const ABOVE = 3; // lines above the values that a table may have
const SPARE = 1.05; // margin, because lines differ in length
const MORE = 1.2; // and where that is too little, how many times as many rows are left out in each attempt
const CHUNK = 1 << 22; // bytes read at a time
const LOOK = 4096; // bytes from which the kind of a file is recognised
const PIECE = 144 * 1024; // bytes of a file that is sent whole, at a time: in base64 less than the server accepts
const PACKED = ["PK\x03\x04", "\xd0\xcf\x11\xe0"], XML = /^(\xef\xbb\xbf)?\s*<(\?xml|object)/; // how such a file begins
const LETTERS = 200; // of a file's name
const LONG = /(\d[.,]\d{7})\d+/g; // more digits than a film can have

/** @typedef {{ most: number, rows: number, head: number }} Limits bytes of a text as it is sent, rows, and the first lines that are always kept */
/** @typedef {[text: string, each: number]} Kept what is kept, and one in how many rows of the file that is */

/** @type {Kept} */
const TOO_LARGE = ["", 0];

/** @param {number} length @param {number} most @returns {number} each how-manieth row is kept */
const everyOf = (length, most) => (length <= most ? 1 : Math.ceil(length / most * SPARE));

// A message is JSON, where a tab or a quote takes two bytes.
/** @param {string} text @returns {number} bytes */
export const sizeOf = (text) => new TextEncoder().encode(JSON.stringify(text)).length;

// The first lines are always kept, because they contain the names. Of the others, those are kept whose number in the
// file is divisible by `each`, so that Python can tell where in the file a line was. If the lines are so long that none
// of the others can be kept, it is TOO_LARGE.
/**
 * @param {string} text @param {Limits} limits
 * @param {number[] | null} [numbers] the numbers of its lines in the file, from 0
 * @param {number} [before] the file has already been thinned to one line in `before`
 * @returns {Kept}
 */
export function thinned(text, { most, rows, head }, numbers = null, before = 1) {
  const short = sizeOf(text) <= most ? text : text.replace(LONG, "$1"), lines = short.split(/\r\n|\r|\n/), size = sizeOf(short);
  const few = lines.length <= rows + ABOVE, number = (i) => (numbers ? numbers[i] : i), last = number(lines.length - 1);
  let more = Math.max(everyOf(size, most), few ? 1 : Math.ceil((lines.length - head) / (rows - head)));
  if (more === 1) return [short, before];
  while (more * before <= last) {
    const each = more * before, kept = lines.filter((_, i) => number(i) < head || number(i) % each === 0);
    const thin = kept.join("\n");
    if (sizeOf(thin) <= most) return kept.slice(head).some(Boolean) ? [thin, each] : TOO_LARGE;
    more = Math.ceil(more * MORE); // its lines differ in length
  }
  return TOO_LARGE;
}

/** @param {Uint8Array} bytes the beginning of a file @returns {string} its encoding */
export function encodingOf(bytes) {
  if (bytes[0] === 0xff && bytes[1] === 0xfe) return "utf-16le";
  if (bytes[0] === 0xfe && bytes[1] === 0xff) return "utf-16be";
  return new TextDecoder().decode(bytes.subarray(0, bytes.length - 4)).includes("\ufffd") ? "windows-1252" : "utf-8";
}

// Thins a file like thinned(), but reads it piece by piece, so that it can be larger than the memory. For a file that
// is not text, returns its first bytes, from which Python can tell.
/**
 * @param {Blob} file @param {Limits} limits
 * @param {(share: number) => void} reached
 * @returns {Promise<Kept>}
 */
export async function readFile(file, limits, reached) {
  const { most, head } = limits;
  const first = new Uint8Array(await file.slice(0, LOOK).arrayBuffer()), encoding = encodingOf(first);
  const decoder = new TextDecoder(encoding), wide = encoding.startsWith("utf-16");
  if (!wide && first.includes(0)) return [new TextDecoder("windows-1252").decode(first), 1];
  if (file.size <= 2 * most) return thinned(decoder.decode(await file.arrayBuffer()), limits);
  const sample = decoder.decode(first), shorter = sample.replace(LONG, "$1").length / first.length;
  const each = everyOf(file.size * shorter, most), kept = [], numbers = [], stream = new TextDecoder(encoding);
  let line = 0, rest = "";
  for (let at = 0; at < file.size; at += CHUNK) {
    const bytes = await file.slice(at, at + CHUNK).arrayBuffer(), last = at + CHUNK >= file.size;
    const lines = (rest + stream.decode(bytes, { stream: !last })).split(/\r\n|\r(?!$)|\n/);
    rest = last ? "" : lines.pop() ?? "";
    if (rest.length > most) return TOO_LARGE; // no table has such a long line
    for (const each_line of lines) {
      if (line < head || line % each === 0) {
        kept.push(each_line.replace(LONG, "$1"));
        numbers.push(line);
      }
      line += 1;
    }
    reached(Math.min(1, (at + CHUNK) / file.size));
  }
  return thinned(kept.join("\n"), limits, numbers, each);
}

/** @param {Uint8Array} bytes @returns {string} each byte as a letter */
const letters = (bytes) => Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");

// Whether a file is no text, and has to be opened.
/** @param {Blob} file @returns {Promise<boolean>} */
export async function isPacked(file) {
  const start = letters(new Uint8Array(await file.slice(0, 64).arrayBuffer()));
  return PACKED.some((each) => start.startsWith(each)) || XML.test(start);
}

// The pieces of a file: of one that is too large a single empty one.
/**
 * @param {Blob} file @param {number} most bytes
 * @returns {AsyncGenerator<[text: string, at: number, count: number]>} in base64
 */
export async function* piecesOf(file, most) {
  const count = file.size > most ? 1 : Math.ceil(file.size / PIECE);
  for (let at = 0; at < count; at += 1) {
    const bytes = file.size > most ? new ArrayBuffer(0) : await file.slice(at * PIECE, (at + 1) * PIECE).arrayBuffer();
    yield [btoa(letters(new Uint8Array(bytes))), at, count];
  }
}

/** @param {Rendering<MeasuredFileModel>} rendering */
export function renderMeasuredFile(rendering) {
  const { model, el } = rendering, { texts } = model, signal = lifeOf(rendering);
  const input = part("input", { type: "file", accept: KINDS, "aria-label": texts.choose }), area = part("textarea", { rows: 1, "aria-label": texts.paste, placeholder: texts.paste });
  const says = part("div", { class: "says", role: "status" }), over = part("div", { class: "over", hidden: true }, part("b", {}, texts.drop));
  el.replaceChildren(part("style", {}, STYLE), part("div", { class: "row" }, part("label", {}, texts.open, input), area, says), over);
  let count = Math.max(model.table[2] ?? 0, model.piece[3] ?? 0);
  /** @param {Kept} kept @param {number} size of all that was brought, in bytes @param {string} [name] */
  const send = ([text, each], size, name = "") => {
    count += 1;
    model.table = [text, each, count, name.slice(0, LETTERS), size]; // choosing the same file again counts as well
  };
  const sendTyped = () => send(thinned(area.value, model), sizeOf(area.value));
  /** @param {File | undefined} file */
  const read = async (file) => {
    if (!file) return;
    try {
      const reached = (share) => (says.textContent = fill(texts.reading, { name: file.name, percent: Math.round(100 * share) }));
      if (await isPacked(file)) {
        count += 1;
        for await (const [text, at, of] of piecesOf(file, model.packed)) {
          model.piece = [text, at, of, count, file.name.slice(0, LETTERS), file.size];
          reached((at + 1) / of);
        }
      } else send(await readFile(file, model, reached), file.size, file.name);
      says.textContent = "";
    } catch {
      says.textContent = fill(texts.unreadable, { name: file.name });
    }
  };
  input.onchange = async () => {
    await read(input.files?.[0]);
    input.value = "";
  };
  area.onchange = () => area.value.trim() && sendTyped();
  area.onpaste = () => setTimeout(() => {
    sendTyped();
    area.value = "";
  });
  const isSeen = () => el.isConnected && el.clientWidth > 0, brings = (event) => event.dataTransfer?.types.includes("Files");
  const shows = (event, shown) => {
    if (!isSeen() || !brings(event)) return false;
    event.preventDefault();
    over.hidden = !shown;
    return true;
  };
  window.addEventListener("dragover", (event) => shows(event, true), { signal });
  window.addEventListener("dragleave", (event) => event.relatedTarget === null && shows(event, false), { signal });
  window.addEventListener("drop", (event) => shows(event, false) && read(event.dataTransfer?.files[0]), { signal });
}
