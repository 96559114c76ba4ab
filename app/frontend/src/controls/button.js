// Buttons.
import { follow } from "../life.js";
import { frame } from "./frame.js";
import { part } from "../parts.js";

const pressed = `button[aria-disabled=true] { opacity: .45; cursor: default; } button[aria-busy=true] { opacity: .6; cursor: progress; }
.outline { text-align: center; white-space: nowrap; }`;

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
