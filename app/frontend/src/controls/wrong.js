// Why something cannot be: the first sentence in bold, and a button for each way out.
import { part } from "../parts.js";

/**
 * @param {HTMLElement} place
 * @param {string} message empty: nothing is wrong
 * @param {[says: string, take: () => void][]} ways
 * @param {boolean} [isHtml]
 */
export function explain(place, message, ways, isHtml = false) {
  place.hidden = !message;
  if (!message) return place.replaceChildren();
  const [first, ...more] = message.split(/(?<=[.]) /), bold = part("b", {}, first), rest = part("span", {}, ` ${more.join(" ")} `);
  if (isHtml) [bold.innerHTML, rest.innerHTML] = [first, ` ${more.join(" ")} `];
  const buttons = ways.flatMap(([says, take]) => [part("button", { type: "button", class: "link", onclick: take }, says), " "]);
  place.replaceChildren(part("b", { class: "mark", "aria-hidden": "true" }, "!"), part("span", {}, bold, rest, ...buttons));
}
