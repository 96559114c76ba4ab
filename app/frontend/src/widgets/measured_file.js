// A table that is chosen, dropped or pasted. It is read here, and of one that is too long rows are left out.
import { colours } from "../colours.js";

const FRAME = `<style>
  .drop { font: 14px/1.4 system-ui, sans-serif; color: var(--ink, #22303c); border: 1px dashed; border-radius: 8px;
    padding: 10px 12px; display: flex; flex-wrap: wrap; gap: 8px 12px; align-items: center }
  .drop.over { background: ${colours.chosen}22 }
  textarea { flex: 1 1 180px; min-width: 0; height: 34px; font: inherit; color: inherit; background: transparent;
    border: 1px solid #8a96a3; border-radius: 6px; padding: 5px 8px; box-sizing: border-box; resize: vertical }
  input { max-width: 100%; font: inherit; color: inherit }
  :focus-visible { outline: 2px solid; outline-offset: 2px }</style>
  <div class="drop"><input type="file" accept=".csv,.tsv,.txt,text/*"><span></span><textarea></textarea></div>`;
const LARGEST = 5e7; // bytes of a file
const HEAD = 12; // first lines, which are always kept: names stand there
const SPARE = 1.05; // lines are not of one length

/** @param {string} text @param {number} most @returns {[string, number]} what is kept of it, and each how-manieth row */
export function thinned(text, most) {
  if (text.length <= most) return [text, 1];
  const each = Math.ceil(text.length / most * SPARE);
  return [text.split(/\r\n|\r|\n/).filter((_, i) => i < HEAD || i % each === 0).join("\n"), each];
}

/** @param {Uint8Array} bytes of a file that a spreadsheet or a telephone saved */
export function decoded(bytes) {
  const wide = bytes[0] === 0xff && bytes[1] === 0xfe;
  const text = new TextDecoder(wide ? "utf-16le" : "utf-8").decode(bytes);
  return text.includes("\ufffd") ? new TextDecoder("windows-1252").decode(bytes) : text;
}

/** @param {Rendering<MeasuredFileModel>} rendering */
export function renderMeasuredFile({ model, el }) {
  el.innerHTML = FRAME;
  const zone = /** @type {HTMLDivElement} */ (el.querySelector(".drop"));
  const input = /** @type {HTMLInputElement} */ (el.querySelector("input"));
  const area = /** @type {HTMLTextAreaElement} */ (el.querySelector("textarea"));
  const { choose, drop, paste } = model.texts;
  input.setAttribute("aria-label", choose);
  zone.querySelectorAll("span")[0].textContent = drop;
  area.placeholder = paste;
  area.setAttribute("aria-label", paste);
  /** @param {string} text */
  const send = (text) => (model.table = thinned(text, model.most));
  /** @param {File | undefined} file */
  const read = async (file) => {
    if (!file) return;
    if (file.size > LARGEST) model.refused = Math.ceil(file.size / 1e6);
    else send(decoded(new Uint8Array(await file.arrayBuffer())));
  };
  input.onchange = () => read(input.files?.[0]);
  area.onchange = () => area.value.trim() && send(area.value);
  area.onpaste = () => setTimeout(() => {
    send(area.value);
    area.value = "";
  });
  zone.ondragover = (event) => {
    event.preventDefault();
    zone.classList.add("over");
  };
  zone.ondragleave = () => zone.classList.remove("over");
  zone.ondrop = (event) => {
    event.preventDefault();
    zone.classList.remove("over");
    read(event.dataTransfer?.files[0]);
  };
}
