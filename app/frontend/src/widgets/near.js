// Whether the card that contains this is on the screen, or so close that it may soon be.
const NEAR = "200px"; // beyond the window, and beyond scrolling parts of the page

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
