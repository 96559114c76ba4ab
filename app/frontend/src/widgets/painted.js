// Resolves when the browser has painted everything that came before the call.
/** @param {Pick<Rendering<PaintedModel>, "model">} rendering */
export const renderPainted = ({ model }) => model.on("sent", () => requestAnimationFrame(() => setTimeout(() => (model.painted = model.sent))));
