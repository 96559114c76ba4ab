// A button that opens a file of text, and a fold.
import { follow } from "../life.js";
import { frame } from "./frame.js";
import { part } from "../parts.js";

const opens = `label { display: inline-flex; align-items: center; cursor: pointer; border-radius: 6px; min-height: 36px; } label:hover { background: color-mix(in srgb, var(--ink) 7%, transparent); }
label:focus-within { outline: 3px solid var(--accent); outline-offset: 2px; } input { position: absolute; opacity: 0; width: 1px; height: 1px; }`;

/** @param {Rendering<TextFileModel>} rendering */
export function renderTextFile(rendering) {
  const { model } = rendering;
  const input = part("input", { type: "file", accept: model.accept, onchange: async () => {
    const file = input.files?.[0];
    if (!file) return;
    const text = file.size > model.most ? "" : await file.text();
    model.sent = [text, model.sent[1] + 1, file.size];
    input.value = ""; // so that it can be chosen again
  } });
  const words = part("span");
  frame(rendering, `${opens} .outline span { display: inline; font-size: inherit; color: inherit; }`, part("label", { class: "outline" }, words, input));
  follow(model, ["label"], () => (words.textContent = model.label));
}

const folds = `summary { min-height: var(--touch); padding: 8px 0; cursor: pointer; list-style: none; display: flex; justify-content: space-between; font-weight: 600; border-top: 1px solid var(--line); }
summary::-webkit-details-marker { display: none; } summary::after { content: "+"; } [open] > summary::after { content: "−"; }`;

/** @param {Rendering<FoldModel>} rendering */
export function renderFold(rendering) {
  const { model } = rendering, words = part("span");
  frame(rendering, folds, part("details", {}, part("summary", {}, words), model.get_child("content")));
  follow(model, ["label"], () => (words.textContent = model.label));
}
