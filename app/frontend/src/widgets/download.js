import { bytesOf } from "../data.js";
import { addButton, save } from "./saving.js";

/** @param {Rendering<DownloadModel>} rendering */
export function renderDownload({ model, el }) {
  const button = addButton(el, model.label);
  button.onclick = () => (model.clicks += 1);
  const show = () => button.setAttribute("aria-busy", String(model.making));
  model.on("making", show);
  show();
  model.on("file", () => save(new Blob([bytesOf(model.file[1])]), model.file[2]));
}
