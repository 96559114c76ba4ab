// Keeps a frame in the page's look: light or dark, and large. Returns a function that ends that.
/** @param {HTMLElement} frame @param {() => void} [drawAnew] is called after each change, and now */
export function followLook(frame, drawAnew = () => {}) {
  const take = () => {
    const look = document.documentElement.dataset.look ?? "";
    frame.dataset.look = look.startsWith("dark") ? "dark" : "light";
    frame.toggleAttribute("data-large", look.endsWith("large"));
    frame.toggleAttribute("data-framed", document.documentElement.dataset.framed !== undefined);
    drawAnew();
  };
  take();
  window.addEventListener("tippe:look", take);
  return () => window.removeEventListener("tippe:look", take);
}
