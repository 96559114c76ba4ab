// Messages over the whole page: the server could not do what was requested, will do it later, or is gone.
import { colours } from "../colours.js";
import { atEnd, lifeOf } from "../life.js";
import { part } from "../parts.js";

const ABOVE = { position: "fixed", margin: "auto", maxWidth: "560px", borderRadius: "8px", color: "white", background: colours.ink,
  font: "14px/1.4 var(--family, system-ui, sans-serif)", boxShadow: "0 2px 8px #0000004d" };
const FIRST = 500, LONGEST = 8000; // ms between two attempts, each randomly changed by up to half

/** @param {"alert" | "status"} role @param {object} style */
const notice = (role, style) => part("div", { role, style: { ...ABOVE, ...style } });

// One sentence, until a person closes it or reloads the page.
/** @param {Pick<Rendering<FailureModel>, "model">} rendering */
export function renderFailure({ model }) {
  const words = notice("alert", { inset: "auto 8px 8px", zIndex: 9998, display: "flex", gap: "12px", alignItems: "center", padding: "8px 8px 8px 16px" });
  const close = part("button", { style: { font: "inherit", color: "inherit", background: "transparent", border: "1px solid", borderRadius: "6px", padding: "4px 10px", cursor: "pointer" },
    onclick: () => words.remove() }, model.close);
  model.on("times", () => {
    words.replaceChildren(model.words, close);
    document.body.append(words);
  });
  const queue = notice("status", { inset: "auto 8px 8px", zIndex: 9997, padding: "8px 16px" });
  model.on("waits", () => {
    queue.textContent = model.waits;
    if (model.waits) document.body.append(queue);
    else queue.remove();
  });
  atEnd(lifeOf({ model }), () => [words, queue].forEach((each) => each.remove()));
}

// A listener that works without the server cancels the event: then there is no message and no reload.
const tellLost = () => window.dispatchEvent(new CustomEvent("tippe:lost", { cancelable: true }));
const tellBack = () => window.dispatchEvent(new CustomEvent("tippe:back", { cancelable: true }));

// When a server answers again, the page is reloaded: its address contains what was set.
/** @param {Pick<Rendering<ConnectionModel>, "model">} rendering */
export function renderConnection({ model }) {
  const words = notice("alert", { inset: "8px 8px auto", zIndex: 9999, padding: "10px 16px", textAlign: "center" });
  let recovering = false;
  async function recover() {
    if (recovering) return;
    recovering = true;
    words.textContent = model.words;
    if (tellLost()) document.body.append(words);
    for (let wait = FIRST; ; wait = Math.min(2 * wait, LONGEST)) {
      await new Promise((resolve) => setTimeout(resolve, wait * (0.5 + Math.random())));
      // An expired login redirects: then reloading leads to the login page.
      const answer = await fetch("./readyz", { cache: "no-store", redirect: "manual", signal: AbortSignal.timeout(LONGEST) }).catch(() => null);
      if (answer && answer.status < 500) return tellBack() && location.reload();
    }
  }
  Bokeh.documents[0].on_event("connection_lost", recover);
  const hear = (/** @type {CustomEvent<string>} */ { detail }) => {
    if (detail === "lost") recover();
    if (recovering) return;
    words.textContent = model.slow;
    if (detail === "slow") document.body.append(words);
    else words.remove();
  };
  window.addEventListener("tippe:answer", hear, { signal: lifeOf({ model }) });
}
