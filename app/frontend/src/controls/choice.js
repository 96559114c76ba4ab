// One of several, by buttons.
import { follow } from "../life.js";
import { frame } from "./frame.js";
import { segments } from "./style.js";
import { Choice, part } from "../parts.js";

const style = `${segments} .choice { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 8px; } @media (max-width: 700px) { .seg button { min-height: 44px; } }`;

/** @param {Rendering<ChoiceModel>} rendering */
export function renderChoice(rendering) {
  const { model } = rendering, { label } = model;
  const choice = new Choice({ role: "radio", label, kind: "seg", choose: (value) => (model.value = value) });
  frame(rendering, style, part("div", { class: "choice" }, ...(label ? [part("b", { "aria-hidden": "true" }, label)] : []), choice.element));
  follow(model, ["options", "value"], () => {
    choice.offer(Object.entries(model.options).map(([word, value]) => [value, word]));
    choice.show(model.value);
  });
}
