// Saves a picture of the top as shown, with its caption below.
import { colours } from "../colours.js";
import { saveButton } from "../controls/button.js";
import { local, penOf } from "../data.js";
import { photosOf } from "../motion/clock.js";
import { part } from "../parts.js";
import { save } from "./saving.js";

const LINE = 1.5; // line height of a caption, in units of the font size

// The moment that pictures show, in symbols that are the same in every language.
/** @param {{ seconds: number, tilt: number }[]} shown */
const moment = (shown) => local(`t = ${shown[0].seconds.toFixed(2)} s, θ = ${shown.map(({ tilt }) => `${tilt.toFixed(0)}°`).join(" / ")}`);

/** @param {HTMLCanvasElement[]} pictures to be placed side by side @param {string[]} caption */
function withCaption(pictures, caption) {
  const high = Math.max(...pictures.map(({ height }) => height)), wide = pictures.reduce((sum, { width }) => sum + width, 0), type = Math.round(wide / 75);
  const canvas = part("canvas", { width: wide, height: high + 2 * type + LINE * type * caption.length }), ink = penOf(canvas);
  ink.fillStyle = "white";
  ink.fillRect(0, 0, canvas.width, canvas.height);
  let x = 0;
  for (const picture of pictures) {
    ink.drawImage(picture, x, 0);
    x += picture.width;
  }
  Object.assign(ink, { fillStyle: colours.ink, textAlign: "center", textBaseline: "top", font: `${type}px system-ui, sans-serif` });
  caption.forEach((line, i) =>
    ink.fillText(line, canvas.width / 2, high + type + LINE * type * i, 0.98 * canvas.width));
  return canvas;
}

/** @param {Rendering<PhotoModel>} rendering */
export function renderPhoto(rendering) {
  const { model } = rendering, button = saveButton(rendering, "PNG"), none = part("span", { role: "status" });
  button.before(none);
  button.onclick = () => {
    const shown = photosOf(model.wide);
    none.textContent = shown.length ? "" : `${model.none} `;
    if (shown.length) withCaption(shown.map(({ picture }) => picture), [...model.caption, moment(shown)]).toBlob((blob) => blob && save(blob, "tippe-top-3d.png"));
  };
}
