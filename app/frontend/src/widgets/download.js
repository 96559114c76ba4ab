import { saveButton } from "../controls/button.js";
import { bytesOf } from "../data.js";
import { follow } from "../life.js";
import { save } from "./saving.js";

/** @param {Rendering<DownloadModel>} rendering */
export function renderDownload(rendering) {
  const { model } = rendering, button = saveButton(rendering, model.label);
  button.onclick = () => !model.disabled && (model.clicks += 1);
  follow(model, ["making", "disabled"], () => {
    button.setAttribute("aria-busy", String(model.making));
    button.setAttribute("aria-disabled", String(model.disabled));
  });
  model.on("file", () => save(new Blob([bytesOf(model.file[1])]), model.file[2]));
}
