// A text to copy, and a button that copies it, even on a page without https, where the browser's own way is forbidden.
import { colours } from "../colours.js";

const FRAME = `<style>
  :host > div { width: 100% }
  .copy { display: flex; width: 100%; gap: 8px; align-items: flex-start }
  textarea { flex: 1 1 0; min-width: 0; font: calc(13px * var(--type, 1))/1.5 ui-monospace, monospace; padding: 7px 9px;
    border: 1px solid #8a96a3; border-radius: 6px; color: inherit; background: transparent; resize: none;
    box-sizing: border-box }
  button { font: 500 calc(13px * var(--type, 1)) var(--family, system-ui, sans-serif); padding: 7px 12px; border: 1px solid; border-radius: 6px;
    background: transparent; color: var(--link, ${colours.chosen}); cursor: pointer; white-space: nowrap; min-width: 72px }
  button:hover { background: ${colours.chosen}14 } :focus-visible { outline: 2px solid; outline-offset: 2px }
  </style><div class="copy"><textarea readonly spellcheck="false"></textarea><button></button></div>`;
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
export function renderCopy({ model, el }) {
  el.innerHTML = FRAME;
  const area = /** @type {HTMLTextAreaElement} */ (el.querySelector("textarea"));
  const button = /** @type {HTMLButtonElement} */ (el.querySelector("button"));
  const [copy, copied] = model.button;
  button.textContent = copy;
  const show = () => {
    area.value = model.text;
    area.rows = model.rows;
    area.style.whiteSpace = model.rows > 1 ? "pre" : "nowrap";
    area.style.overflow = model.rows > 1 ? "auto" : "hidden";
    area.setAttribute("aria-label", model.label);
  };
  area.onfocus = () => area.select();
  button.onclick = async () => {
    await copyText(model.text, area);
    button.textContent = copied;
    setTimeout(() => (button.textContent = copy), SAID_MS);
  };
  for (const name of ["text", "label", "rows"]) model.on(name, show);
  show();
}
