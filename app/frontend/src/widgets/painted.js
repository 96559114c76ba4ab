// Answers once the browser has painted what came before the question.
import { closeSidebar } from "../borrowed.js";

const NARROW = 900; // px; too narrow for controls beside the pictures

/** @param {Pick<Rendering<PaintedModel>, "model">} rendering */
export function renderPainted({ model }) {
  if (innerWidth < NARROW) closeSidebar();
  model.on("sent", () => requestAnimationFrame(() => setTimeout(() => (model.painted = model.sent))));
}
