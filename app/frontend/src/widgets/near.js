// Whether the card that this lies in is on the screen, or so near that it soon may be.
const NEAR = "200px"; // beyond the window, and beyond what scrolls in it

/** @param {Pick<Rendering<NearModel>, "model" | "el">} rendering */
export function renderNear({ model, el }) {
  el.style.cssText = "position: absolute; inset: 0";
  const seeing = new IntersectionObserver((entries) => {
    const near = entries[entries.length - 1].isIntersecting;
    if (model.near !== near) model.near = near;
  }, /** @type {any} */ ({ rootMargin: NEAR, scrollMargin: NEAR }));
  seeing.observe(el);
  model.on("remove", () => seeing.disconnect());
}
