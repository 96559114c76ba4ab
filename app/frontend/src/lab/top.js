// A top in 3-D for the Lab: it has no bar of its own, and its model is created here.
import { renderTop3D } from "../three/top3d.js";
import { part } from "./parts.js";

// The Lab has its own words for these.
const OURS = ".tippe :is(.bar, .verdict, .scales, .time) { display: none } div.tippe { min-height: 0 } .tippe > .picture { border-radius: 0; min-height: 0 }";

const SHOWS = {
  show_track: false, show_com_path: false, show_force: false, show_cone: false, show_omega: false, show_momentum: false, follow: true,
};

export class Top {
  /**
   * @param {object} of @param {Record<string, any>} of.texts @param {string} of.label @param {import("./time.js").Time} of.time
   * @param {number} of.away distance of the camera, in units of the distance at which the whole top just fits
   * @param {{ pull(degrees: number): void, letGo(): void }} [of.hand] what dragging the axis does
   */
  constructor({ texts, label, time, away, hand }) {
    const listeners = new Map(), put = (changes) => this.put(changes);
    this.listeners = listeners;
    this.element = part("div", { class: "top" });
    const values = {
      texts, label, clock: time.name, frames: null, profile: null, mu_s: 0, seconds: 1, time: 0, a: null, before: null, azimuth: undefined,
      tiltable: Boolean(hand), degrees: true, letGo: () => hand?.letGo(), playing: true, camera: [-1.12, 0.26, away], ...SHOWS,
      get speed() { return time.speed; },
      set speed(_) {},
      get until() { return time.end / time.unit; },
      set tilted([theta, , , azimuth]) {
        put({ azimuth });
        hand?.pull((180 / Math.PI) * theta);
      },
      on: (name, run) => listeners.set(name, [...(listeners.get(name) ?? []), run]),
    };
    this.model = /** @type {any} */ (values);
    this.view = {};
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
  put(changes) {
    const names = Object.keys(changes).filter((name) => this.model[name] !== changes[name]);
    for (const name of names) this.model[name] = changes[name];
    if (this.begun) for (const name of names) for (const run of this.listeners.get(name) ?? []) run();
  }

  leave() {
    for (const run of this.listeners.get("remove") ?? []) run();
  }
}
