// "Spin it". A press uses the spin that is set; holding the button increases the spin. While a run is computed,
// progress and a button to stop it are shown instead.
import { part, say } from "../parts.js";

const LONG = 300, FULL = 2000; // ms: a longer press is a hold; from there to the greatest spin

// The fraction of the greatest spin after holding the button for so long; null while it is only a press.
/** @param {number} held ms */
export const strengthOf = (held) => (held < LONG ? null : Math.min((held - LONG) / FULL, 1));

/**
 * @param {Record<string, any>} texts
 * @param {{ spin: () => void, strength: (share: number) => string, launch: () => void, stop: () => void }} of
 *     strength: shows a fraction of the greatest spin, and returns it in words; launch: requests what was shown last
 */
export function launchOf(texts, of) {
  let word = "", since = 0, frame = 0, charged = false;
  const charge = (/** @type {number} */ now) => {
    const share = strengthOf(now - since);
    charged ||= share !== null;
    if (share !== null) button.textContent = of.strength(share);
    frame = requestAnimationFrame(charge);
  };
  const end = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    button.textContent = word;
  };
  const button = part("button", {
    class: "primary", type: "button", title: texts.spin_hint, onpointerup: end, oncontextmenu: (event) => event.preventDefault(), // of a long touch
    onpointerdown: (event) => {
      if (event.button) return;
      button.setPointerCapture(event.pointerId);
      since = event.timeStamp;
      charged = false;
      frame = requestAnimationFrame(charge);
    },
    onpointercancel: () => {
      charged = false;
      end();
    },
    onclick: () => {
      if (charged) of.launch();
      charged = false;
      of.spin();
    },
  });
  const progress = part("progress", { max: 1, "aria-label": texts.progress }), share = part("span", { class: "small" });
  const wait = part("div", { class: "wait", hidden: true }, progress, share, part("button", { class: "outline", type: "button", onclick: of.stop }, texts.stop));
  return { element: part("div", { class: "launch" }, button, wait), show(/** @type {any} */ { table, waits, state: { reached = 0 } }) {
    word = table === "three" ? texts.spin_all : texts.spin_it;
    if (!charged) button.textContent = word;
    button.hidden = waits && !frame; // a button that is held stays under the pointer
    wait.hidden = !waits;
    progress.value = reached;
    share.textContent = say(texts, texts.percent, { share: [100 * reached, 0] });
  } };
}
