// The top as it is seen, with its caption below, as a file.
import { colours } from "../colours.js";
import { penOf } from "../data.js";
import { photoOf } from "../motion/clock.js";
import { addButton, save } from "./saving.js";

const LINE = 1.5; // of a caption, in sizes of its type

/** @param {HTMLCanvasElement} picture @param {string[]} caption */
function withCaption(picture, caption) {
  const type = Math.round(picture.width / 75), canvas = document.createElement("canvas"), ink = penOf(canvas);
  canvas.width = picture.width;
  canvas.height = picture.height + 2 * type + LINE * type * caption.length;
  ink.fillStyle = "white";
  ink.fillRect(0, 0, canvas.width, canvas.height);
  ink.drawImage(picture, 0, 0);
  ink.fillStyle = colours.ink;
  ink.textAlign = "center";
  ink.textBaseline = "top";
  ink.font = `${type}px system-ui, sans-serif`;
  caption.forEach((line, i) =>
    ink.fillText(line, canvas.width / 2, picture.height + type + LINE * type * i, 0.98 * canvas.width));
  return canvas;
}

/** @param {Rendering<PhotoModel>} rendering */
export function renderPhoto({ model, el }) {
  addButton(el, "PNG").onclick = () => {
    const picture = photoOf(model.wide);
    if (picture) withCaption(picture, model.caption).toBlob((blob) => blob && save(blob, "tippe-top-3d.png"));
  };
}
