// Pointing at a symbol, in a picture, at a control or in a sentence, shows its sketch and meaning; pointing at a term
// of the glossary shows its explanation. A symbol is recognised by its HTML: <i>K</i><sub>J</sub>.
import { hideReadout, showReadout } from "../figures/readout.js";
import { lifeOf } from "../life.js";
import { sketchOf } from "./sketches.js";
import { watchTerms } from "./terms.js";

// {the symbol's HTML: its name in controls.toml}
const NAMES = {
  K_J: "K_J", K_R: "K_R", E: "energy", "θ": "angle", "θ̇": "theta_dot", "ω_3": "omega3", "ω_2′": "omega2", a: "a", I_1: "I1", I_3: "I3",
  "μ_s": "mu_s", "μ_k": "mu_k", "μ": "mu", F_z: "normal", u: "slip", t: "time", "ε": "eps", "γ": "gamma",
};

/** The name of the symbol that an element belongs to. @param {Element} part @returns {string | undefined} */
export function symbolOf(part) {
  const letter = part.matches("i") ? part : part.matches("sub") && part.previousSibling?.nodeName === "I" ? part.previousElementSibling : null;
  if (!letter) return undefined;
  const next = letter.nextSibling, below = next?.nodeName === "SUB" ? `_${next.textContent}` : "";
  return NAMES[`${letter.textContent}${below}`.trim()];
}

// A title would open the browser's own tooltip over ours.
function quiet(part, words) {
  const titled = part.closest("[title]");
  if (!titled || !words.startsWith(titled.getAttribute("title"))) return;
  titled.setAttribute("aria-description", words);
  titled.removeAttribute("title");
}

/** @param {Rendering<Model>} rendering */
export function renderSymbols({ model }) {
  const signal = lifeOf({ model }), owner = {};
  const over = (event) => {
    const part = event.composedPath()[0], name = part instanceof Element ? symbolOf(part) : undefined, words = name && model.texts.symbols[name];
    if (!name || !words) return;
    quiet(part, words);
    part.style.cursor = "help";
    const box = part.getBoundingClientRect();
    showReadout(owner, `${sketchOf(name) ?? ""}<div>${words}</div>`, [event.clientX, event.clientY], [box]);
  };
  const hide = () => hideReadout(owner);
  document.addEventListener("pointerover", over, { signal });
  document.addEventListener("pointerout", (event) => event.pointerType !== "touch" && hide(), { signal });
  document.addEventListener("pointerdown", (event) => symbolOf(/** @type {Element} */ (event.composedPath()[0])) === undefined && hide(), { signal });
  window.addEventListener("scroll", hide, { capture: true, passive: true, signal });
  watchTerms(model.texts.terms, signal);
}
