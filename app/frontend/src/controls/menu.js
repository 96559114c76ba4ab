// A menu, and checks.
import { follow } from "../life.js";
import { frame } from "./frame.js";
import { part } from "../parts.js";

let made = 0; // for the ids of labels

const list = `.menu { display: inline-flex; flex-direction: column; max-width: 100%; }
label { color: var(--ink-2); font-size: var(--t-s); } select { max-width: 100%; padding: 0 4px 0 0; text-overflow: ellipsis; }`;

/** @param {Rendering<MenuModel>} rendering */
export function renderMenu(rendering) {
  const { model } = rendering, id = `menu-${(made += 1)}`;
  const select = part("select", { id, onchange: () => (model.value = Object.values(model.options)[select.selectedIndex]) });
  const label = part("label", { for: id }), place = part("div", { class: "menu" }, label, select);
  frame(rendering, list, place);
  const show = () => (select.selectedIndex = Object.values(model.options).indexOf(model.value));
  follow(model, ["options", "label"], () => {
    label.textContent = model.label;
    select.replaceChildren(...Object.keys(model.options).map((word) => part("option", {}, word)));
    show();
  });
  model.on("value", show);
}

const boxes = `fieldset { border: 0; margin: 0; padding: 0; min-width: 0; display: flex; flex-wrap: wrap; gap: 0 16px; align-items: center; } legend { padding: 0; color: var(--ink-2); font-size: var(--t-s); }
legend:empty { display: none; } label { display: inline-flex; gap: 8px; align-items: center; min-height: var(--touch); cursor: pointer; } input { width: 18px; height: 18px; margin: 0; accent-color: var(--accent); }`;

/** @param {Rendering<ChecksModel>} rendering */
export function renderChecks(rendering) {
  const { model } = rendering, place = part("fieldset");
  frame(rendering, boxes, place);
  const all = () => /** @type {HTMLInputElement[]} */ ([...place.querySelectorAll("input")]);
  const show = () => all().forEach((box, i) => (box.checked = model.value.includes(Object.values(model.options)[i])));
  const set = () => (model.value = Object.values(model.options).filter((_, i) => all()[i].checked));
  follow(model, ["options", "label"], () => {
    place.replaceChildren(part("legend", {}, model.label),
      ...Object.keys(model.options).map((word) => part("label", {}, part("input", { type: "checkbox", onchange: set }), word)));
    show();
  });
  model.on("value", show);
}
