// Controls in folds, like those of the start: the top's lengths and ballast, and the friction of the table.
import { Control } from "../controls/number.js";
import { part } from "../parts.js";

/** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {"body" | "rubs"} word @param {"dims" | "rubs"} of their key in the state @param {any[]} first what stands above them */
export function foldOf(texts, ask, word, of, ...first) {
  const place = part("div"), element = part("details", { class: "body" }, part("summary", {}, texts[word]), ...first, place);
  let names = "", controls = /** @type {Control[]} */ ([]);
  return { element, show(/** @type {any} */ state, /** @type {boolean} */ ahead) {
    const wanted = state[of] ?? [];
    element.hidden = !wanted.length;
    if (JSON.stringify(wanted) !== names) {
      names = JSON.stringify(wanted);
      controls = wanted.map(([name, wording, unit]) => new Control(name, { name: wording, typed: wording, unit }, texts, ask));
      place.replaceChildren(...controls.map((control) => control.element));
    }
    for (const control of controls) {
      control.show(state, ahead);
      control.note(state.notes[control.name] ?? "");
      if (state.messages[control.name]) element.open = true;
    }
  } };
}
