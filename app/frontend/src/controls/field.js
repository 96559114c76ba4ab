// An entry for a short text.
import { fill } from "../data.js";
import { follow } from "../life.js";
import { entry } from "./entry.js";
import { frame } from "./frame.js";
import { numbers } from "./style.js";
import { explain } from "./wrong.js";
import { part } from "../parts.js";

let made = 0; // for the ids of labels
const style = `${numbers} .field { display: inline-flex; flex-wrap: wrap; align-items: baseline; gap: 0 8px; } .field .num { height: max(28px, var(--touch) - 4px); } @media (max-width: 700px) { .field .num { height: 44px; } }
.field .unit { margin: 0; min-width: 0; } .unit:empty { display: none; } .wrong { flex: 1 0 100%; max-width: 60ch; } i, sub { font-family: Georgia, serif; } sub { font-size: .75em; line-height: 0; }
.num::placeholder { color: var(--ink-2); opacity: 1; } .field label { color: var(--ink-2); }`;

/** @param {Rendering<FieldModel>} rendering */
export function renderField(rendering) {
  const { model } = rendering, { texts } = model, id = `field-${(made += 1)}`;
  const send = (text) => {
    number.value = text;
    if (text !== model.value) model.value = text;
  };
  const number = entry({ id, "aria-describedby": `${id}-wrong` }, send, () => (number.value = model.value));
  const label = part("label", { for: id }), unit = part("span", { class: "unit" }), wrong = part("p", { class: "wrong", id: `${id}-wrong`, role: "alert", hidden: true });
  const place = part("div", { class: "field" }, label, part("span", {}, number, " ", unit), wrong);
  frame(rendering, style, place);
  follow(model, ["value", "label", "shows", "unit", "placeholder", "size", "wrong"], () => {
    if (!number.isTyping && number.value !== model.value) number.value = model.value;
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
