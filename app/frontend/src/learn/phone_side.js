// A phone in a class: the number of the question, that its vote was sent, how many have voted, and the way to the
// lesson alone.
import { part, say } from "../lab/parts.js";

export class PhoneSide {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {() => void} replay */
  constructor(texts, ask, replay) {
    const { room } = texts.lesson;
    this.which = part("span", { class: "small" });
    this.head = part("header", { class: "phone-head" }, part("b", {}, room.title), this.which,
      part("button", { type: "button", class: "round", "aria-label": texts.again_hint, onclick: replay }, "↺"));
    this.count = part("p", { role: "status" });
    this.said = part("p", { role: "alert" });
    this.again = part("button", { type: "button", class: "primary", onclick: () => ask("again", "") }, room.again);
    this.alone = part("a", { target: "_blank" }, room.alone);
    this.foot = part("div", { class: "phone-foot" }, this.count, this.said, this.again);
    this.follows = part("footer", { class: "follows" }, part("span", { class: "small" }, room.follows), this.alone);
  }

  /** @param {any} state @param {Record<string, any>} texts */
  put({ room, said, again, alone }, texts) {
    const words = texts.lesson.room, open = Boolean(room?.code);
    const mine = open && room.mine !== null && room.mine !== undefined;
    this.which.textContent = open ? say(texts, words.which, { code: room.code, i: room.place }) : "";
    this.said.textContent = said;
    this.again.hidden = !again;
    this.alone.href = alone;
    this.count.replaceChildren(...(open ? [part("b", {}, `${room.voted} ${say(texts, words.voted, { phones: room.phones })}.`), " ",
      room.shown ? words.shown : mine ? words.change : words.vote] : []));
    const lesson = this.head.parentElement;
    lesson?.classList.toggle("empty", !open);
    lesson?.style.setProperty("--sent", mine ? JSON.stringify(words.sent) : "none"); // shown beside the chosen answer
  }
}
