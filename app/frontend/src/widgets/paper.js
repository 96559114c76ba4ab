// Opens a page to print in a new window.
import { addButton } from "./saving.js";

/** @param {Rendering<PaperModel>} rendering */
export function renderPaper({ model, el }) {
  addButton(el, model.label).onclick = () => {
    const paper = window.open("", "_blank");
    if (!paper) return;
    paper.document.open(); // this also removes old listeners
    paper.addEventListener("load", () => paper.print());
    paper.document.write(model.page);
    paper.document.close();
  };
}
