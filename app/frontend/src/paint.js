// Paints parts of the page on a canvas, each where it stands on the page: its words, its box, its drawing.
const DRAWN = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "stroke-linejoin", "paint-order",
  "opacity", "font-family", "font-size", "font-weight", "text-anchor"];

/** @typedef {{ x: number, y: number }} Origin the point of the page that is the corner of the canvas */

/** @param {CanvasRenderingContext2D} pen @param {Element} element @param {Origin} origin */
export function paintWords(pen, element, { x, y }) {
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT), range = document.createRange();
  for (let node = /** @type {any} */ (walker.nextNode()); node; node = walker.nextNode()) {
    const { color, textShadow, fontStyle, fontWeight, fontSize, fontFamily, letterSpacing } = getComputedStyle(node.parentElement);
    Object.assign(pen, { fillStyle: color, font: `${fontStyle} ${fontWeight} ${fontSize} ${fontFamily}`, letterSpacing });
    const halo = textShadow.match(/^rgba?\([^)]*\)/)?.[0];
    for (const { index, 0: word } of node.data.matchAll(/\S+/g)) {
      range.setStart(node, index);
      range.setEnd(node, index + word.length);
      const box = range.getBoundingClientRect();
      if (!box.width) continue;
      /** @type {[string, number, number]} */
      const at = [word, box.x - x, box.y - y + pen.measureText(word).fontBoundingBoxAscent];
      if (halo) {
        Object.assign(pen, { strokeStyle: halo, lineWidth: 3, lineJoin: "round" });
        pen.strokeText(...at);
      }
      pen.fillText(...at);
    }
  }
}

// Its background and border.
/** @param {CanvasRenderingContext2D} pen @param {Element} element @param {Origin} origin */
export function paintBox(pen, element, { x, y }) {
  const box = element.getBoundingClientRect(), { backgroundColor, borderRadius, borderTopWidth, borderTopColor } = getComputedStyle(element);
  const wide = parseFloat(borderTopWidth);
  Object.assign(pen, { fillStyle: backgroundColor, strokeStyle: borderTopColor, lineWidth: wide });
  pen.beginPath();
  pen.roundRect(box.x - x + wide / 2, box.y - y + wide / 2, box.width - wide, box.height - wide, parseFloat(borderRadius) || 0);
  pen.fill();
  if (wide) pen.stroke();
}

// A drawing as it looks now, as a picture of its own.
/** @param {SVGElement} drawing */
export async function imageOf(drawing) {
  const copy = /** @type {SVGElement} */ (drawing.cloneNode(true)), { width, height } = drawing.getBoundingClientRect();
  const all = (each) => [each, ...each.querySelectorAll("*")], copies = all(copy);
  all(drawing).forEach((each, i) => {
    const style = getComputedStyle(each);
    for (const name of DRAWN) copies[i].style.setProperty(name, style.getPropertyValue(name));
  });
  for (const [name, value] of Object.entries({ width, height })) copy.setAttribute(name, String(value));
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await image.decode();
  return image;
}
