// "Spin it". A press uses the spin that is set; holding the button increases the spin. While a run is computed,
// progress and a button to stop it are shown instead.
import { part, say } from "./parts.js";

const LONG = 300, FULL = 2000; // ms: a longer press is a hold; from there to the greatest spin

// The fraction of the greatest spin after holding the button for so long; null while it is only a press.
/** @param {number} held ms */
export const strengthOf = (held) => (held < LONG ? null : Math.min((held - LONG) / FULL, 1));

export class Launch {
  /**
   * @param {Record<string, any>} texts
   * @param {{ spin: () => void, strength: (share: number) => string, launch: () => void, stop: () => void }} of
   *     strength: shows a fraction of the greatest spin, and returns it in words; launch: requests what was shown last
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
    this.button.addEventListener("contextmenu", (event) => event.preventDefault()); // of a long touch
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
    this.button.hidden = waits && !this.frame; // a button that is held stays under the pointer
    this.wait.hidden = !waits;
    this.progress.value = state.reached ?? 0;
    this.share.textContent = say(texts, texts.percent, { share: [100 * (state.reached ?? 0), 0] });
  }
}
