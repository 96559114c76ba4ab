// What every part that stands in the page alone begins with.
import { followLook } from "./look.js";
import { shared } from "./style.js";
import { part } from "../widgets/parts.js";

const alone = `${shared}
.frame { container-type: normal; background: none; flex: 1 1 auto; min-width: 0; }
@media (max-width: 700px) { .frame, .frame[data-large] { --touch: 44px; } :is(.primary, .outline, .link, select, .num) { min-height: 44px; } }
`;

// Puts a part into its place, in the page's look. Panel may build a view again without sending "remove".
/** @param {Rendering<Model>} rendering @param {string} style @param {any[]} parts @returns {HTMLElement} */
export function frame({ model, el, view }, style, ...parts) {
  view.tippe?.dispose();
  const made = part("div", { class: "frame" }, ...parts), dispose = followLook(made);
  el.replaceChildren(part("style", {}, alone + style), made);
  view.tippe = { dispose };
  model.on("remove", dispose);
  return made;
}

// Calls look whenever the part comes into sight; leave: what else ends with it.
/** @param {Rendering<Model>} rendering @param {Element} element @param {() => void} look */
export function whenSeen({ model, view }, element, look, leave = () => {}) {
  const seeing = new IntersectionObserver(([{ isIntersecting }]) => isIntersecting && look()), { tippe } = view;
  seeing.observe(element);
  const dispose = () => {
    seeing.disconnect();
    leave();
    tippe?.dispose();
  };
  model.on("remove", dispose);
  view.tippe = { dispose };
}

// Shows now, and whenever one of these values changes.
/** @param {Model} model @param {string[]} names @param {() => void} show */
export function follow(model, names, show) {
  for (const name of names) model.on(name, show);
  show();
}
