// A page to print, in a window of its own.
import { addButton } from "./saving.js";

/** @param {Rendering<PaperModel>} rendering */
export function renderPaper({ model, el }) {
  addButton(el, model.label).onclick = () => {
    const paper = window.open(URL.createObjectURL(new Blob([model.page], { type: "text/html" })), "_blank");
    paper?.addEventListener("load", () => paper.print());
  };
}
