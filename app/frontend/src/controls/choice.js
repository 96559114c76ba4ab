// One of several, by buttons.
import { follow, frame } from "./frame.js";
import { segments } from "./style.js";
import { Choice, part } from "../widgets/parts.js";

const style = `${segments} .choice { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 8px; } @media (max-width: 700px) { .seg button { min-height: 44px; } }`;

/** @param {Rendering<ChoiceModel>} rendering */
export function renderChoice(rendering) {
  const { model } = rendering, place = part("div", { class: "choice" });
  frame(rendering, style, place);
  /** @type {Choice} */
  let choice;
  const show = () => choice.show(model.value);
  follow(model, ["options"], () => {
    choice = new Choice({ role: "radio", label: model.label, options: Object.entries(model.options).map(([word, value]) => [value, word, ""]),
      choose: (value) => (model.value = value) });
    choice.element.className = "seg";
    place.replaceChildren(...(model.label ? [part("b", { "aria-hidden": "true" }, model.label)] : []), choice.element);
    show();
  });
  model.on("value", show);
}
