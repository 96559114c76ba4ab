// Whether a person is using a control of the page, rather than a 3-D picture.
const HAND_MS = 350; // ms after the last input at which the control counts as released
let inputAt = -Infinity;
const isCanvas = (target) => target.localName === "canvas";
const onInput = (event) => {
  const used = event.type === "keydown" || event.buttons > 0;
  if (used && !event.composedPath().some(isCanvas)) inputAt = performance.now(); // a canvas: the person turns the picture itself
};
for (const type of ["pointerdown", "pointermove", "keydown"]) window.addEventListener(type, onInput, { capture: true });

/** @param {number} now */
export const isHandOn = (now) => now - inputAt < HAND_MS;
