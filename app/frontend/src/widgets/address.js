// The page's own address and keys: what a person set stands in it without a step in the browser's history.
import { onLettingGo } from "./press.js";

const MUTE = ["Control", "Shift", "Alt", "Meta", "Tab"]; // keys that set nothing

const isWriting = (target) => target.isContentEditable || target.matches?.(
  "textarea, select, input:not([type=range]):not([type=checkbox]):not([type=radio]):not([type=button])");

// Which parameter a key counts up: what the keyboard of the system takes back or makes anew with.
/** @param {Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">} event @returns {"undone" | "redone" | null} */
export function stepOf({ key, ctrlKey, metaKey, altKey, shiftKey }) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  const letter = key.toLowerCase();
  if ((letter === "y" && !shiftKey) || (letter === "z" && shiftKey)) return "redone";
  return letter === "z" ? "undone" : null;
}

/** @param {Rendering<AddressModel>} rendering */
export function renderAddress({ model }) {
  const listening = new AbortController(), options = { capture: true, signal: listening.signal };
  const down = () => {
    model.gesture += 1;
    model.held = true;
  };
  const up = () => {
    if (model.held) model.held = false;
  };
  window.addEventListener("pointerdown", down, options);
  window.addEventListener("keyup", up, options);
  onLettingGo(up, listening.signal);
  const onKey = (/** @type {KeyboardEvent} */ event) => {
    const writing = isWriting(event.composedPath()[0]), step = writing ? null : stepOf(event);
    if (step) {
      event.preventDefault();
      model[step] += 1;
    } else if ((!writing || event.key === "Enter") && !event.repeat && !MUTE.includes(event.key)) down();
  };
  window.addEventListener("keydown", onKey, options);
  const write = () => history.replaceState(history.state, "", location.pathname + model.search + location.hash);
  model.on("search", write);
  if (model.search) write(); // what was set before this was here
  model.on("reloads", () => location.reload());
  model.page = location.origin + location.pathname;
  model.on("remove", () => listening.abort());
}
