import { follow } from "../life.js";

// A sentence that changes with what is shown; it uses the page's style sheets.
/** @param {Pick<Rendering<SaidModel>, "model" | "el">} rendering */
export const renderLiveText = ({ model, el }) => follow(model, ["text"], () => (el.innerHTML = model.text));
