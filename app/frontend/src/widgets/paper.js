// Opens a page to print in a new window; where there may be none, as in many frames, it is saved as a file.
import { saveButton } from "../controls/button.js";
import { save } from "./saving.js";

/** @param {Rendering<PaperModel>} rendering */
export function renderPaper(rendering) {
  const { model } = rendering;
  saveButton(rendering, model.label).onclick = () => {
    const paper = window.open("", "_blank");
    if (!paper) return void save(new Blob([model.page], { type: "text/html" }), "tippe-top-sheet.html");
    paper.document.open(); // this also removes old listeners
    paper.addEventListener("load", () => paper.print());
    paper.document.write(model.page);
    paper.document.close();
  };
}
