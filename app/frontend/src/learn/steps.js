// Cohen's top by several laws of friction, and by Coulomb's in steps whose length a slider chooses.
import { onBoth } from "../colours.js";
import { drawn, part, say } from "../parts.js";
import { coalesce } from "../data.js";
import { frame } from "../controls/frame.js";
import { Graph } from "./graph.js";
import { style } from "./style.js";

/** @param {Rendering<StepsModel>} rendering */
export function renderSteps(rendering) {
  const { model } = rendering, { texts } = model, wording = texts.steps;
  const graph = new Graph(texts);
  const range = part("input", { type: "range", min: 0, max: 0, step: 1, value: 0, "aria-label": wording.step, oninput: () => show() });
  const chosen = part("output");
  const list = part("ul", { "aria-live": "polite" });
  const label = part("label", { class: "step" }, part("span", {}, wording.step), range, chosen);
  const showing = coalesce(show);

  function show() {
    const steps = model.curves.filter(({ step }) => step), laws = model.curves.filter(({ step }) => !step);
    label.hidden = !steps.length;
    if (label.hidden) return list.replaceChildren(part("li", {}, wording.working));
    range.max = String(steps.length - 1);
    const present = steps[Number(range.value)];
    const curves = [...laws, present];
    chosen.textContent = range.ariaValueText = say(texts, wording.milliseconds, { step: [present.step, 0] });
    list.replaceChildren(...curves.map(({ name, says, link, colour, dash }) => part("li", {}, swatch(colour, dash),
      part("span", {}, part("b", {}, `${name}: `), says, " ", link && part("a", { href: link }, texts.open)))));
    graph.show({ step: { picture: "graph", end: 0, graph: { x: wording.x, y: wording.y, of: "x", curves: curves.map((curve) => ({ ...curve, word: "" })), points: model.points } },
      record: { requested: false, seen: Infinity }, tops: [0] });
  }

  const swatch = (colour, dash) => drawn("svg", { class: "swatch", viewBox: "0 0 26 8", "aria-hidden": "true" },
    drawn("path", { class: "line", d: "M1 4H25", stroke: onBoth(colour), "stroke-dasharray": { dashed: "7 4", dotted: "2 4" }[dash] }));
  model.on("curves", showing);
  frame(rendering, style, part("div", { class: "steps" }, graph.element, label, list));
  show();
}
