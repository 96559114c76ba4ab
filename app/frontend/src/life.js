// How long a part of the page lives, and what it follows meanwhile.

// A signal that ends when Panel removes a part, or builds it again, which it may do without sending "remove".
/** @param {Pick<Rendering<Model>, "model"> & Partial<Pick<Rendering<Model>, "view">>} rendering @param {Partial<Rendering<Model>["view"]["tippe"]>} [more] what else its view offers */
export function lifeOf({ model, view = {} }, more = {}) {
  view.tippe?.dispose();
  const life = new AbortController(), dispose = () => life.abort();
  view.tippe = { dispose, life: life.signal, ...more };
  model.on("remove", dispose);
  return life.signal;
}

/** Calls run at the end of a life. @param {AbortSignal | undefined} life @param {() => void} run */
export const atEnd = (life, run) => life?.addEventListener("abort", run);

/** Calls look now, and whenever the look of the page changes. @param {() => void} look @param {AbortSignal} [life] */
export function onLook(look, life) {
  window.addEventListener("tippe:look", look, { signal: life });
  look();
}

export const isDark = () => Boolean(document.documentElement.dataset.look?.startsWith("dark"));

// Shows now, and whenever one of these values changes.
/** @param {Model} model @param {string[]} names @param {() => void} show */
export function follow(model, names, show) {
  for (const name of names) model.on(name, show);
  show();
}

// Marks a frame that is in large type, or in a frame of another page.
/** @param {HTMLElement} frame @param {AbortSignal} [life] @param {() => void} [drawAnew] is called after each change of the look, and now */
export const followLook = (frame, life, drawAnew = () => {}) => onLook(() => {
  const { look, framed } = document.documentElement.dataset;
  frame.toggleAttribute("data-large", Boolean(look?.endsWith("large")));
  frame.toggleAttribute("data-framed", framed !== undefined);
  drawAnew();
}, life);

// A report of what is drawn, for tests, by its name as long as it lives.
/** @param {string} name @param {() => object} read @param {AbortSignal} [life] */
export function report(name, read, life) {
  const reports = window.__tippe;
  Object.defineProperty(reports, name, { get: read, configurable: true, enumerable: true });
  atEnd(life, () => Object.getOwnPropertyDescriptor(reports, name)?.get === read && delete reports[name]);
}
