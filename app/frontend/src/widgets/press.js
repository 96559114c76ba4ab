// A pointer that is down, wherever on the page that is.

// Calls run when it is let go, or the window is left; not when what had the focus loses it to what is pressed.
/** @param {() => void} run @param {AbortSignal} signal */
export function onLettingGo(run, signal) {
  const options = { capture: true, signal };
  for (const type of ["pointerup", "pointercancel", "dragend"]) window.addEventListener(type, run, options);
  window.addEventListener("blur", (event) => event.target === window && run(), options);
}

// now: which press is down; 0 for none, the first is 1.
export class Press {
  constructor() {
    this.now = this.count = 0;
    this.listening = new AbortController();
    const { signal } = this.listening;
    window.addEventListener("pointerdown", () => (this.now = this.count += 1), { capture: true, signal });
    onLettingGo(() => (this.now = 0), signal);
  }

  leave() {
    this.listening.abort();
  }
}
