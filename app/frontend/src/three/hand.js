// Whether a person's hand is on a control of the page, not on a picture in 3-D.
const HAND_MS = 350; // how long after its last input a hand is taken to have let go
let inputAt = -Infinity;
const isCanvas = (target) => target.localName === "canvas";
const onInput = (event) => {
  const used = event.type === "keydown" || event.buttons > 0;
  if (used && !event.composedPath().some(isCanvas)) inputAt = performance.now(); // a canvas: turning the picture itself
};
for (const type of ["pointerdown", "pointermove", "keydown"]) window.addEventListener(type, onInput, { capture: true });

/** @param {number} now */
export const isHandOn = (now) => now - inputAt < HAND_MS;
