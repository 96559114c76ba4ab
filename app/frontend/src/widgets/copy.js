// A text to copy, and a button that copies it, even on a page without https, where the browser's own way is forbidden.
import { follow, frame } from "../controls/frame.js";
import { part } from "./parts.js";

const STYLE = `:host > div { width: 100%; } .copy { display: flex; width: 100%; gap: 8px; align-items: flex-start; }
textarea { flex: 1 1 0; min-width: 0; font: var(--t-s)/1.5 ui-monospace, monospace; padding: 8px; border: 1px solid var(--line-2); border-radius: 6px; color: inherit; background: none; resize: none; }
.outline { min-width: 76px; text-align: center; }`;
const SAID_MS = 1500;

/** @param {string} text @param {HTMLInputElement | HTMLTextAreaElement} field which contains it */
export async function copyText(text, field) {
  field.select();
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    document.execCommand("copy");
  }
}

/** @param {Rendering<CopyModel>} rendering */
export function renderCopy(rendering) {
  const { model } = rendering, [copy, copied] = model.button;
  const area = part("textarea", { readonly: true, spellcheck: "false", onfocus: () => area.select() });
  const button = part("button", { type: "button", class: "outline", onclick: async () => {
    await copyText(model.text, area);
    button.textContent = copied;
    setTimeout(() => (button.textContent = copy), SAID_MS);
  } }, copy);
  frame(rendering, STYLE, part("div", { class: "copy" }, area, button));
  follow(model, ["text", "label", "rows"], () => {
    area.value = model.text;
    area.rows = model.rows;
    area.style.whiteSpace = model.rows > 1 ? "pre" : "nowrap";
    area.style.overflow = model.rows > 1 ? "auto" : "hidden";
    area.setAttribute("aria-label", model.label);
  });
}
