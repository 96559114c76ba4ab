import { part } from "../parts.js";

// Saves a file.
const KEPT_MS = 60000;

/** @param {Blob} blob @param {string} filename */
export function save(blob, filename) {
  const link = part("a", { href: URL.createObjectURL(blob), download: filename });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
