// The law of friction of the ordinary table, and what happens where the top hops: for the level "Research".
import { Choice, part } from "../parts.js";

/** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask */
export function lawOf(texts, ask) {
  const { more } = texts;
  const choice = (name, label, words) => new Choice({ role: "radio", label, kind: "seg", options: Object.entries(words), choose: (chosen) => ask(name, chosen) });
  const law = choice("law", texts.law, more.law), landing = choice("landing", more.lands, more.landing);
  const stem = part("input", { type: "checkbox", onchange: () => ask("stem", stem.checked) }), touches = part("label", { class: "touches" }, stem, more.stem);
  const examples = part("select", { "aria-label": more.example, onchange: () => {
    if (examples.value) ask("example", examples.value);
    examples.value = "";
  } }, part("option", { value: "" }, more.example), ...Object.entries(more.presets).map(([name, word]) => part("option", { value: name }, word)));
  return {
    element: part("div", { class: "law" }, examples, law.element, part("p", { class: "small" }, more.lands), landing.element, touches),
    show(/** @type {any} */ { friction: [rubs, lands, counts], touches: isHit }) {
      law.show(rubs);
      landing.show(lands);
      stem.checked = counts;
      touches.hidden = !isHit;
    },
  };
}
