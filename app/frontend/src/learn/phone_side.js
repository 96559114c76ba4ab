// A phone in a class: the number of the question, that its vote was sent, how many have voted, and the way to the
// lesson alone.
import { part, say } from "../parts.js";

/** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {() => void} replay */
export function phoneSide(texts, ask, replay) {
  const words = texts.lesson.room, which = part("span", { class: "small" }), count = part("p", { role: "status" }), wording = part("p", { role: "alert" });
  const again = part("button", { type: "button", class: "primary", onclick: () => ask("again", "") }, words.again), alone = part("a", { target: "_blank" }, words.alone);
  const head = part("header", { class: "phone-head" }, part("b", {}, words.title), which,
    part("button", { type: "button", class: "round", "aria-label": texts.again_hint, onclick: replay }, "↺"));
  return {
    head, foot: part("div", { class: "phone-foot" }, count, wording, again), follows: part("footer", { class: "follows" }, part("span", { class: "small" }, words.follows), alone),
    put(/** @type {any} */ { room, ...state }) {
      const open = Boolean(room?.code), mine = open && room.mine !== null && room.mine !== undefined;
      which.textContent = open ? say(texts, words.which, { code: room.code, i: room.place }) : "";
      wording.textContent = state.wording;
      again.hidden = !state.again;
      alone.href = state.alone;
      count.replaceChildren(...(open ? [part("b", {}, `${room.voted} ${say(texts, words.voted, { phones: room.phones })}.`), " ",
        room.shown ? words.shown : mine ? words.change : words.vote] : []));
      head.parentElement?.classList.toggle("empty", !open);
      head.parentElement?.style.setProperty("--sent", mine ? JSON.stringify(words.sent) : "none"); // shown beside the chosen answer
    },
  };
}
