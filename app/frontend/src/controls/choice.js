// One of several, by buttons.
import { segments, shared } from "./style.js";
import { followLook } from "./look.js";
import { Choice, part } from "../widgets/parts.js";

const style = `${shared}${segments}
.frame, .frame[data-look=dark] { --ground: var(--card, #fff); container-type: normal; }
.choice { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 8px; }
@media (max-width: 700px) { .seg button { min-height: 44px; } }
`;

/** @param {Rendering<ChoiceModel>} rendering */
export function renderChoice({ model, el, view }) {
  view.tippe?.dispose(); // Panel may build a view again without sending "remove"
  const place = part("div", { class: "choice" }), frame = part("div", { class: "frame" }, place);
  el.replaceChildren(part("style", {}, style), frame);
  /** @type {Choice} */
  let choice;
  const show = () => choice.show(model.value);
  const build = () => {
    choice = new Choice({ role: "radio", label: model.label, options: Object.entries(model.options).map(([word, value]) => [value, word, ""]),
      choose: (value) => (model.value = value) });
    choice.element.className = "seg";
    place.replaceChildren(...(model.label ? [part("b", { "aria-hidden": "true" }, model.label)] : []), choice.element);
    show();
  };
  build();
  model.on("options", build);
  model.on("value", show);
  view.tippe = { dispose: followLook(frame) };
  model.on("remove", () => view.tippe?.dispose());
}
