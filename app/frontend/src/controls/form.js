// Buttons, entries, menus and checks, each of native elements.
import { fill } from "../data.js";
import { follow, frame } from "./frame.js";
import { numbers } from "./style.js";
import { explain } from "./wrong.js";
import { part } from "../widgets/parts.js";

let made = 0; // for the ids of labels

const pressed = `button[aria-disabled=true] { opacity: .45; cursor: default; } button[aria-busy=true] { opacity: .6; cursor: progress; }
.outline { text-align: center; white-space: nowrap; } .primary { width: 100%; }`;

// A disabled one keeps the focus, and stays a stop for a keyboard.
/** @param {Rendering<ButtonModel>} rendering */
export function renderButton(rendering) {
  const { model } = rendering;
  const button = part("button", { type: "button", onclick: () => !model.disabled && (model.clicks += 1) });
  frame(rendering, pressed, button);
  follow(model, ["label", "kind", "disabled"], () => {
    button.className = model.kind;
    button.textContent = model.label;
    button.setAttribute("aria-disabled", String(model.disabled));
  });
}

// A button that saves a file.
/** @param {Rendering<Model>} rendering @param {string} label */
export function saveButton(rendering, label) {
  const button = part("button", { type: "button", class: "outline" }, label);
  frame(rendering, `${pressed} .outline { min-width: 76px; }`, button);
  return button;
}

const entry = `${numbers} .field { display: inline-flex; flex-wrap: wrap; align-items: baseline; gap: 0 8px; } .field .num { height: max(28px, var(--touch) - 4px); } @media (max-width: 700px) { .field .num { height: 44px; } }
.field .unit { margin: 0; min-width: 0; } .unit:empty { display: none; } .wrong { flex: 1 0 100%; max-width: 60ch; } i, sub { font-family: Georgia, serif; } sub { font-size: .75em; line-height: 0; }
.num::placeholder { color: var(--ink-2); opacity: 1; } .field label { color: var(--ink-2); }`;

/** @param {Rendering<FieldModel>} rendering */
export function renderField(rendering) {
  const { model } = rendering, { texts } = model, id = `field-${(made += 1)}`;
  let isTyping = false;
  const send = (text) => {
    isTyping = false;
    number.value = text;
    if (text !== model.value) model.value = text;
  };
  const commit = () => isTyping && send(number.value);
  const number = part("input", {
    type: "text", class: "num", id, inputmode: "decimal", autocomplete: "off", spellcheck: "false", maxlength: 60, "aria-describedby": `${id}-wrong`,
    oninput: () => (isTyping = true), onchange: commit, onblur: commit,
    onkeydown: ({ key }) => {
      if (key === "Enter") commit();
      if (key !== "Escape" || !isTyping) return;
      isTyping = false;
      number.value = model.value;
    },
  });
  const label = part("label", { for: id }), unit = part("span", { class: "unit" }), wrong = part("p", { class: "wrong", id: `${id}-wrong`, role: "alert", hidden: true });
  const place = part("div", { class: "field" }, label, part("span", {}, number, " ", unit), wrong);
  frame(rendering, entry, place);
  follow(model, ["value", "label", "shows", "unit", "placeholder", "size", "wrong"], () => {
    if (!isTyping && number.value !== model.value) number.value = model.value;
    label.innerHTML = model.shows;
    label.hidden = !model.shows;
    number.setAttribute("aria-label", model.label);
    number.placeholder = model.placeholder;
    number.style.width = `${model.size}ch`;
    unit.textContent = model.unit;
    const [why, nearest, back] = model.wrong;
    place.classList.toggle("bad", Boolean(why));
    number.setAttribute("aria-invalid", String(Boolean(why)));
    /** @type {[string, string | undefined][]} */
    const ways = [[texts.take, nearest], [texts.back, back]];
    explain(wrong, why ?? "", ways.flatMap(([says, text]) => (text ? [[fill(says, { value: text }), () => send(text)]] : [])));
  });
}

const list = `.menu { display: inline-flex; flex-direction: column; max-width: 100%; } .menu.beside { flex-direction: row; align-items: center; gap: 8px; }
label { color: var(--ink-2); font-size: var(--t-s); } .beside label { font-size: inherit; white-space: nowrap; } select { max-width: 100%; min-width: 0; margin-left: -4px; text-overflow: ellipsis; }`;

/** @param {Rendering<MenuModel>} rendering */
export function renderMenu(rendering) {
  const { model } = rendering, id = `menu-${(made += 1)}`;
  const select = part("select", { id, onchange: () => (model.value = Object.values(model.options)[select.selectedIndex]) });
  const label = part("label", { for: id }), place = part("div", { class: "menu" }, label, select);
  frame(rendering, list, place);
  const show = () => (select.selectedIndex = Object.values(model.options).indexOf(model.value));
  follow(model, ["options", "label", "is_beside"], () => {
    label.textContent = model.label;
    place.classList.toggle("beside", model.is_beside);
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
