// Answers once the browser has painted what came before the question.
/** @param {Pick<Rendering<PaintedModel>, "model">} rendering */
export function renderPainted({ model }) {
  model.on("sent", () => requestAnimationFrame(() => setTimeout(() => (model.painted = model.sent))));
}
