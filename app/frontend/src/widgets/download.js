import { saveButton } from "../controls/button.js";
import { bytesOf } from "../data.js";
import { save } from "./saving.js";

/** @param {Rendering<DownloadModel>} rendering */
export function renderDownload(rendering) {
  const { model } = rendering, button = saveButton(rendering, model.label);
  button.onclick = () => !model.disabled && (model.clicks += 1);
  const show = () => {
    button.setAttribute("aria-busy", String(model.making));
    button.setAttribute("aria-disabled", String(model.disabled));
  };
  for (const name of ["making", "disabled"]) model.on(name, show);
  show();
  model.on("file", () => save(new Blob([bytesOf(model.file[1])]), model.file[2]));
}
