// What every part that stands in the page alone begins with.
import { atEnd, followLook, lifeOf } from "../life.js";
import { shared } from "./style.js";
import { part } from "../parts.js";

const alone = `${shared}
.frame { container-type: normal; background: none; flex: 1 1 auto; min-width: 0; }
@media (max-width: 700px) { .frame, .frame[data-large] { --touch: 44px; } :is(.primary, .outline, .link, select, .num) { min-height: 44px; } }
`;

// Puts a part into its place, in the page's look.
/** @param {Rendering<Model>} rendering @param {string} style @param {any[]} parts @returns {AbortSignal} its life */
export function frame(rendering, style, ...parts) {
  const life = lifeOf(rendering), made = part("div", { class: "frame" }, ...parts);
  followLook(made, life);
  rendering.el.replaceChildren(part("style", {}, alone + style), made);
  return life;
}

// Calls look whenever an element comes into sight.
/** @param {Element} element @param {() => void} look @param {AbortSignal} life */
export function whenSeen(element, look, life) {
  const seeing = new IntersectionObserver(([{ isIntersecting }]) => isIntersecting && look());
  seeing.observe(element);
  atEnd(life, () => seeing.disconnect());
}
