// A sentence that changes with what is shown; it uses the page's style sheets.
/** @param {Pick<Rendering<SaidModel>, "model" | "el">} rendering */
export function renderSaid({ model, el }) {
  const show = () => (el.innerHTML = model.text);
  model.on("text", show);
  show();
}
