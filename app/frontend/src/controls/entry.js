// A field for a short text, which counts once when Enter is pressed or the field is left; Escape brings back what was. An
// element that was moved in the page raises no "change".
import { part } from "../parts.js";

/** @param {Record<string, any>} attributes @param {(text: string) => void} send @param {() => void} back @returns {any} an input, with whether a person is typing as isTyping */
export function entry(attributes, send, back) {
  const commit = () => {
    if (!input.isTyping) return;
    input.isTyping = false;
    send(input.value);
  };
  const input = part("input", {
    type: "text", class: "num", inputmode: "decimal", autocomplete: "off", spellcheck: "false", maxlength: 60, ...attributes,
    oninput: () => (input.isTyping = true), onchange: commit, onblur: commit,
    onkeydown: ({ key }) => {
      if (key === "Enter") commit();
      if (key !== "Escape" || !input.isTyping) return;
      input.isTyping = false;
      back();
    },
  });
  return input;
}
