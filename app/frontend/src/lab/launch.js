// "Spin it": pressed, with the spin that is set; held, the faster the longer. While a run is computed its place shows how
// far that is, and what stops it.
import { part, say } from "./parts.js";

const LONG = 300, FULL = 2000; // ms: from when a press is a hold, and from there to the greatest spin

// Which share of the greatest spin a button has that is held so long; null while it is only pressed.
/** @param {number} held ms */
export const strengthOf = (held) => (held < LONG ? null : Math.min((held - LONG) / FULL, 1));

export class Launch {
  /**
   * @param {Record<string, any>} texts
   * @param {{ spin: () => void, strength: (share: number) => string, launch: () => void, stop: () => void }} of
   *     strength: shows a share of the greatest spin, and returns it in words; launch: asks for what was shown last
   */
  constructor(texts, of) {
    this.texts = texts;
    this.of = of;
    this.word = "";
    this.since = this.frame = 0;
    this.charged = false;
    this.button = part("button", { class: "primary", type: "button", title: texts.spin_hint, onclick: () => this.click() });
    this.progress = part("progress", { max: 1, "aria-label": texts.progress });
    this.share = part("span", { class: "small" });
    this.wait = part("div", { class: "wait", hidden: true }, this.progress, this.share,
      part("button", { class: "outline", type: "button", onclick: of.stop }, texts.stop));
    this.element = part("div", { class: "launch" }, this.button, this.wait);
    this.button.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      this.button.setPointerCapture(event.pointerId);
      this.since = event.timeStamp;
      this.charged = false;
      this.frame = requestAnimationFrame(this.charge);
    });
    this.button.addEventListener("pointerup", () => this.end());
    this.button.addEventListener("pointercancel", () => {
      this.charged = false;
      this.end();
    });
    this.button.addEventListener("contextmenu", (event) => event.preventDefault()); // of a finger that stays
  }

  /** @param {number} now in ms */
  charge = (now) => {
    const share = strengthOf(now - this.since);
    if (share !== null) {
      this.charged = true;
      this.button.textContent = this.of.strength(share);
    }
    this.frame = requestAnimationFrame(this.charge);
  };

  end() {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.button.textContent = this.word;
  }

  click() {
    if (this.charged) this.of.launch();
    this.charged = false;
    this.of.spin();
  }

  /** @param {any} scene */
  show({ table, waits, state }) {
    const { texts } = this;
    this.word = table === "three" ? texts.spin_all : texts.spin_it;
    if (!this.charged) this.button.textContent = this.word;
    this.button.hidden = waits && !this.frame; // what is held stays under the hand
    this.wait.hidden = !waits;
    this.progress.value = state.reached ?? 0;
    this.share.textContent = say(texts, texts.percent, { share: [100 * (state.reached ?? 0), 0] });
  }
}
