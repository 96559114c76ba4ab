// What a person does anywhere on the page: a pointer that is pressed, and whether a key writes.

/** @param {KeyboardEvent} event */
export const isWriting = (event) => /** @type {Element} */ (event.composedPath()[0]).matches?.(
  "textarea, select, input:not([type=range], [type=checkbox], [type=radio], [type=button]), [contenteditable]:not([contenteditable=false]), [contenteditable] *");

// Calls `run` when it is released, or the window loses the focus; not when the focus moves to the pressed element.
/** @param {() => void} run @param {AbortSignal} signal */
export function onLettingGo(run, signal) {
  const options = { capture: true, signal };
  for (const type of ["pointerup", "pointercancel", "dragend"]) window.addEventListener(type, run, options);
  window.addEventListener("blur", (event) => event.target === window && run(), options);
}

// now: the number of the present press, from 1; 0 if nothing is pressed.
export class Press {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    this.now = this.count = 0;
    window.addEventListener("pointerdown", () => (this.now = this.count += 1), { capture: true, signal });
    onLettingGo(() => (this.now = 0), signal);
  }
}
