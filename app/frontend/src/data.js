import { atEnd } from "./life.js";

// Arrays are sent as bytes and arrive as an ArrayBuffer, so nothing passes through JSON.
/** @param {Bytes} [bytes] */
export function float32(bytes) {
  if (!bytes) return new Float32Array(0);
  if (bytes instanceof ArrayBuffer) return new Float32Array(bytes);
  // A view may start at an offset that is not a multiple of four: then floats can be read only from a copy.
  if (bytes.byteOffset % 4) return new Float32Array(bytes.slice().buffer);
  return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength >> 2);
}

// The last row whose time is not after now; the last but one at most. t may be unevenly spaced; width: numbers in a
// row.
/** @param {Column} t @param {number} now */
export function rowBefore(t, now, width = 1) {
  let low = 0, high = t.length / width - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle * width] <= now) low = middle;
    else high = middle;
  }
  return low;
}

// Decodes base64.
/** @param {string} text */
export const bytesOf = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

// Reads JSON in which bytes are {"base64": text}.
/** @param {string} text */
export const valued = (text) => JSON.parse(text, (_, value) => (typeof value?.base64 === "string" ? bytesOf(value.base64) : value));

// The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8, 10 times a power of ten that is at least x: a round number for a scale.
/** @param {number} x */
export const niceAbove = (x) => (x > 0 && isFinite(x) ? stepOf(x, [1, 1.5, 2, 3, 4, 5, 6, 8]) : 1);

// The smallest round number that is not below another.
/** @param {number} rough @param {number[]} digits that it may begin with */
export function stepOf(rough, digits = [1, 2, 5]) {
  const decade = 10 ** Math.floor(Math.log10(rough));
  return decade * (digits.find((digit) => digit * decade >= rough * (1 - 1e-9)) ?? 10);
}

// Puts numbers into a text of browser.toml.
/** @param {string} text @param {Record<string, any>} values */
export const fill = (text, values) => text.replace(/\{(\w+)\}/g, (_, name) => values[name]);

// Sets a value of the model. While Bokeh is connecting again it throws: then the page goes on, as without a server.
/** @template {object} M @template {keyof M} K @param {M} model @param {K} name @param {NoInfer<M[K]>} value */
export function set(model, name, value) {
  try {
    model[name] = value;
  } catch (error) {
    if (!(error instanceof DOMException)) throw error;
  }
}

// Asks Python for something.
/** @template W @param {{ request: W }} model @param {NoInfer<W>} wish */
export const ask = (model, wish) => set(model, "request", wish);

// Runs once before the next paint, however often it was called before then.
/** @param {() => void} run @param {AbortSignal} [life] @returns {Later} */
export function coalesce(run, life) {
  let frame = 0;
  const later = () => {
    frame ||= requestAnimationFrame(() => {
      frame = 0;
      run();
    });
  };
  later.cancel = () => {
    cancelAnimationFrame(frame);
    frame = 0;
  };
  atEnd(life, later.cancel);
  return later;
}

// Runs once nothing has called it for so long.
/** @param {() => void} run @param {number} ms @param {AbortSignal} [life] */
export function debounce(run, ms, life) {
  let timer = 0;
  atEnd(life, () => clearTimeout(timer));
  return () => {
    clearTimeout(timer);
    timer = setTimeout(run, ms);
  };
}

// The 2-D context of a canvas. It is null only if the canvas is used by WebGL.
/** @param {HTMLCanvasElement} canvas */
export const penOf = (canvas) => /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));

/** @type {Record<string, string>} */
const points = { "": "." };
const pointOf = (language) => new Intl.NumberFormat(language).formatToParts(0.5).find(({ type }) => type === "decimal")?.value ?? ".";

// Writes the text of a number as in the language of the page, with a true minus sign.
/** @param {string} text @param {string} language */
export function local(text, language = typeof document === "undefined" ? "" : (document.documentElement?.lang ?? "")) {
  points[language] ??= pointOf(language);
  return text.replaceAll("-", "−").replace(".", points[language]);
}

// With so many significant digits, as short as it can be written.
/** @param {number} number */
export const tidy = (number, digits = 3) => local(String(Number(number.toPrecision(digits))));

/** @param {number} angle in rad */
export const degrees = (angle) => (180 / Math.PI) * angle;

/** @typedef {{ left: number, right: number, top: number, bottom: number }} Box */

// Whether two boxes overlap.
/** @param {Box} a @param {Box} b */
export const meets = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
