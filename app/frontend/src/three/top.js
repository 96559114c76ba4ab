// A top in 3-D for the Lab: it has no bar of its own, and its model is created here.
import { renderTop3D } from "./top3d.js";
import { degrees } from "../data.js";
import { part } from "../parts.js";
import { atEnd } from "../life.js";
import { modelOf } from "../stand_in.js";

// The Lab has its own words for these.
const OURS = ".tippe .verdict { display: none } :host(:not([data-arrows])) .tippe .scales { display: none }" +
  ".tippe .scales { left: auto; right: 16px; top: 16px } @media (max-width: 1180px) { .tippe .scales { top: 36px } } div.tippe { min-height: 0 } .tippe > .picture { border-radius: 0; min-height: 0 } @container (max-width: 700px) { .tippe .scales { display: none } }";

// What is shown of a motion besides the top itself.
export const SHOWS = ["show_force", "show_omega", "show_momentum", "show_com_path", "show_track", "show_trace", "show_cone", "follow"];
export const ARROWS = ["show_force", "show_omega", "show_momentum"];
export const NOTHING = { ...Object.fromEntries(SHOWS.map((name) => [name, false])), follow: true };

export class Top {
  /**
   * @param {object} of @param {Record<string, any>} of.texts @param {string} of.label @param {import("../lab/time.js").Time} of.time @param {AbortSignal} of.life
   * @param {number} of.away distance of the camera, in units of the distance at which the whole top just fits
   * @param {{ pull(degrees: number): void, letGo(): void }} [of.hand] what dragging the axis does
   * @param {Hand} [of.flick] what a flick on the top does
   * @param {number[]} [of.camera] the view that a person chose before @param {(camera: number[]) => void} [of.turned] hears of another
   */
  constructor({ texts, label, time, life, away, hand, flick, camera: before = [], turned }) {
    const first = [-1.12, 0.26, away];
    let camera = before.length ? before : first;
    this.element = part("div", { class: "top" });
    this.label = label;
    this.model = modelOf({
      texts, label, clock: time.name, now: undefined, frames: null, profile: null, mu_s: 0, seconds: 1, time: 0, a: null, before: null, azimuth: undefined,
      bare: true, flick, pushes: [], playing: true, ...NOTHING,
      pulled: hand && { letGo: hand.letGo, to: (theta, azimuth) => {
        this.put({ azimuth });
        hand.pull(degrees(theta));
      } },
      get camera() { return camera; },
      set camera(chosen) {
        camera = chosen.length ? chosen : first;
        turned?.(chosen);
      },
      get speed() { return time.speed; },
      set speed(_) {},
      get until() { return time.end / time.unit; },
    });
    this.view = /** @type {any} */ ({});
    atEnd(life, () => this.view.tippe?.dispose());
  }

  // Draws it unless it is already drawn.
  begin() {
    if (this.begun) return;
    this.begun = true;
    const shadow = this.element.attachShadow({ mode: "open" }), el = part("div", { style: "height: 100%" });
    shadow.append(part("style", {}, OURS), el);
    renderTop3D({ model: this.model, el, view: this.view });
  }

  /** @param {Record<string, any>} changes */
  put = (changes) => void Object.assign(this.model, changes);

  // What it shows, for those who do not see it; nothing if it shows no motion.
  /** @param {string} words */
  describe(words) {
    const label = words ? `${this.label}. ${words}` : this.label;
    if (this.model.label !== label) this.put({ label });
  }

  firstView() {
    this.model.camera = [];
    this.view.tippe?.look();
  }
}
