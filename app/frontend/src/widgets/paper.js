// Opens a page to print in a new window.
import { saveButton } from "../controls/button.js";

/** @param {Rendering<PaperModel>} rendering */
export function renderPaper(rendering) {
  const { model } = rendering;
  saveButton(rendering, model.label).onclick = () => {
    const paper = window.open("", "_blank");
    if (!paper) return;
    paper.document.open(); // this also removes old listeners
    paper.addEventListener("load", () => paper.print());
    paper.document.write(model.page);
    paper.document.close();
  };
}
