// A text to copy, and a button that copies it, even on a page without https, where the browser's own way is forbidden.
import { frame } from "../controls/frame.js";
import { toCopy } from "../controls/style.js";
import { follow } from "../life.js";
import { part } from "../parts.js";

const STYLE = `:host > div { width: 100%; } .copy { display: flex; width: 100%; gap: 8px; align-items: flex-start; }
textarea { flex: 1 1 0; } ${toCopy}`;
const SAID_MS = 1500;

/** A button that copies the text of a field, and says so. @param {HTMLInputElement | HTMLTextAreaElement} field @param {string} kind @param {[copy: string, copied: string]} words */
export function copyButton(field, kind, [copy, copied]) {
  const button = part("button", { type: "button", class: kind, onclick: async () => {
    field.select();
    try {
      await navigator.clipboard.writeText(field.value);
    } catch {
      document.execCommand("copy");
    }
    button.textContent = copied;
    setTimeout(() => (button.textContent = copy), SAID_MS);
  } }, copy);
  return button;
}

/** @param {Rendering<CopyModel>} rendering */
export function renderCopy(rendering) {
  const { model } = rendering;
  const area = part("textarea", { readonly: true, spellcheck: "false", onfocus: () => area.select() });
  frame(rendering, STYLE, part("div", { class: "copy" }, area, copyButton(area, "outline word", model.button)));
  follow(model, ["text", "label", "rows"], () => {
    area.value = model.text;
    area.rows = model.rows;
    area.style.whiteSpace = model.rows > 1 ? "pre" : "nowrap";
    area.style.overflow = model.rows > 1 ? "auto" : "hidden";
    area.setAttribute("aria-label", model.label);
  });
}
