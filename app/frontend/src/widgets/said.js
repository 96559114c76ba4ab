// A sentence that changes with what is shown; its sheets are the page's own.
/** @param {Pick<Rendering<SaidModel>, "model" | "el">} rendering */
export function renderSaid({ model, el }) {
  const show = () => (el.innerHTML = model.text);
  model.on("text", show);
  show();
}
