// The page in a frame of another page: without its head, as high as what it shows, which its host is told.

// What is as high as the window elsewhere has a height of its own here: the host may follow it.
const PLACE = { "--top": "0px", "--foot": "0px", "--page": "760px" };

/** @param {Pick<Rendering<Model>, "model">} rendering */
export function renderFrame({ model }) {
  const root = document.documentElement, main = /** @type {HTMLElement} */ (document.querySelector("main"));
  root.dataset.framed = "";
  for (const [name, value] of Object.entries(PLACE)) root.style.setProperty(name, value);
  window.dispatchEvent(new CustomEvent("tippe:look"));
  const telling = new ResizeObserver(() => {
    const { offsetHeight: height } = main; // none while the lesson fills the frame, or the screen
    if (height && parent !== window) parent.postMessage({ subject: "lti.frameResize", height }, "*");
  });
  telling.observe(main);
  model.on("remove", () => telling.disconnect());
}
