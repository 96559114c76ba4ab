// The big screen in front of a class: the question and its top fill it, phones vote, and the votes stay hidden until
// the answer.
import { part, say } from "../parts.js";

const LETTERS = "ABCDEFGH";
const KEYS = [["←", "back"], ["→", "on"], ["Space", "play"], ["Alt+R", "reveal"], ["Alt+0", "reset"], ["Esc", "leave"]];

// What a key does; "" for nothing.
/** @param {KeyboardEvent} event @param {boolean} presenting */
export function wishOf(event, presenting) {
  const { key, code, ctrlKey, metaKey, altKey } = event, isAlone = !ctrlKey && !metaKey;
  // not a letter alone: screen readers go to links and paragraphs by letters
  const letter = altKey && isAlone ? { KeyP: presenting ? "leave" : "present", ...(presenting ? { KeyR: "reveal", Digit0: "reset" } : {}) }[code] : "";
  if (letter || !presenting || altKey || !isAlone) return letter || "";
  return { ArrowLeft: "back", ArrowRight: "on", " ": "play", Escape: "leave" }[key] ?? "";
}

// What the big screen covers is not there for a keyboard or a screen reader either.
/** @param {HTMLElement} frame @param {boolean} hidden */
export function hideOthers(frame, hidden) {
  for (let here = /** @type {any} */ (frame); here && here !== document.body; here = here.parentElement ?? here.getRootNode().host) {
    for (const other of here.parentNode?.children ?? []) if (other !== here) other.inert = hidden;
  }
}

export class Presenter {
  /** @param {Record<string, any>} texts @param {(wish: string) => void} wish */
  constructor(texts, wish) {
    this.texts = texts;
    const { room } = texts.lesson;
    this.options = part("ol", { class: "letters" });
    this.code = part("div", { class: "qr", role: "img" });
    this.link = part("p", { class: "link-address" });
    this.warning = part("p", { class: "warning", role: "alert" });
    this.count = part("p", { class: "count", role: "status" });
    this.show = part("button", { type: "button", class: "primary", onclick: () => wish("reveal") }, room.reveal);
    this.next = part("button", { type: "button", class: "primary", onclick: () => wish("on") }, `${texts.lesson.next} →`);
    this.told = part("div", { class: "told" });
    this.board = part("section", { class: "board" }, this.options, this.told, this.code, this.link, this.warning,
      part("div", { class: "counted" }, this.count, this.show, this.next));
    this.dots = part("span", { class: "dots" });
    this.hidden = part("span");
    this.foot = part("footer", { class: "foot" }, this.dots, this.hidden,
      part("span", { class: "keys" }, ...KEYS.map(([key, name]) => part("button", { type: "button", onclick: () => wish(name) }, part("kbd", {}, key), " ", room.keys[name]))));
  }

  /** @param {any} step @param {any} record @param {any} room @param {{ steps: any[], lost: boolean, back: boolean }} around */
  put(step, record, room, { steps, lost, back }) {
    const { texts } = this, wording = texts.lesson.room, open = Boolean(room.code), here = room.step === step.name;
    const votes = Object.fromEntries(here ? room.counts : []), most = Math.max(1, ...Object.values(votes)), done = record.done;
    const options = step.asks?.options ?? (done && here ? room.counts.map(([range]) => [range, range]) : []);
    this.options.replaceChildren(...options.map(([key, word], i) => part("li", { class: done && key === step.truth ? "true" : "" },
      part("b", {}, LETTERS[i] ?? ""), part("span", {}, word, ...(done && here && room.shown ? [part("span", { class: "votes" }, part("i", { style: `width:${(100 * (votes[key] ?? 0)) / most}%` }), part("em", {}, String(votes[key] ?? 0)))] : [])))));
    this.told.replaceChildren(...(done ? [...step.told, `<b>${texts.lesson.learned}:</b> ${step.learned}`].map((words) => Object.assign(part("p"), { innerHTML: words })) : []));
    if (room.picture !== this.picture) this.code.innerHTML = this.picture = room.picture ?? "";
    this.code.hidden = !open || done;
    this.code.setAttribute("aria-label", open ? room.address : "");
    this.link.textContent = open && !done ? room.address.replace(/^https?:\/\//, "") : "";
    this.warning.textContent = back ? wording.back : lost ? wording.lost : room.wording || (room.local && !done ? wording.local : "");
    this.count.replaceChildren(...(open ? room.phones ? [part("b", {}, String(room.voted)), ` ${say(texts, wording.voted, { phones: room.phones })}`] : [wording.nobody] : []));
    this.hidden.textContent = done || !step.asks ? "" : record.requested ? wording.soon : wording.hidden;
    this.show.hidden = Boolean(record.requested) || !step.asks;
    this.next.hidden = !done || steps.at(-1) === step;
    this.dots.replaceChildren(...steps.map((each) => part("i", { class: each === step ? "here" : "" })), ` ${say(texts, wording.place, { i: steps.indexOf(step) + 1, n: steps.length })}`);
  }
}
