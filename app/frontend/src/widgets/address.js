// The page's address, history and keys. The address contains what a person has set; a room, a level or a step of the
// lesson that was opened is an entry of the browser's history.
import { lifeOf } from "../life.js";
import { isWriting, onLettingGo } from "./press.js";

const MUTE = ["Control", "Shift", "Alt", "Meta", "Tab"]; // keys that change nothing by themselves

// The parameter that counts a key: those with which the operating system undoes and redoes.
/** @param {Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">} event @returns {"undone" | "redone" | null} */
export function stepOf({ key, ctrlKey, metaKey, altKey, shiftKey }) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  const letter = key.toLowerCase();
  if ((letter === "y" && !shiftKey) || (letter === "z" && shiftKey)) return "redone";
  return letter === "z" ? "undone" : null;
}

// What a link within the page keeps of its address: how the page looks, its language, and that it is in a frame.
const KEEPS = ["lang", "dark", "large", "frame"];

/** @param {string} search that of the link @param {string} present that of the page */
export function inLook(search, present) {
  const found = new URLSearchParams(search), here = new URLSearchParams(present);
  for (const name of KEEPS) if (here.has(name) && !found.has(name)) found.set(name, here.get(name) ?? "");
  return `?${found}`;
}

/** @param {Rendering<AddressModel>} rendering */
export function renderAddress({ model }) {
  const signal = lifeOf({ model }), options = { capture: true, signal };
  const down = () => {
    model.gesture += 1;
    model.held = true;
  };
  const up = () => {
    if (model.held) model.held = false;
  };
  window.addEventListener("pointerdown", down, options);
  window.addEventListener("keyup", up, options);
  onLettingGo(up, signal);
  const onKey = (/** @type {KeyboardEvent} */ event) => {
    const writing = isWriting(event), step = writing ? null : stepOf(event);
    if (step) {
      event.preventDefault();
      model[step] += 1;
    } else if ((!writing || event.key === "Enter") && !event.repeat && !MUTE.includes(event.key)) down();
  };
  window.addEventListener("keydown", onKey, options);
  window.addEventListener("click", (event) => {
    const link = /** @type {HTMLAnchorElement | undefined} */ (event.composedPath().find((node) => node instanceof HTMLAnchorElement && node.getAttribute("href")?.startsWith("?")));
    if (link) link.search = inLook(link.search, location.search);
  }, options);
  let visiting = ""; // what Back or Forward has requested
  const write = () => {
    if (visiting === model.where) visiting = "";
    const where = visiting || model.where, isNew = where !== (history.state?.where ?? where);
    history[isNew ? "pushState" : "replaceState"]({ ...history.state, where }, "", location.pathname + model.search + location.hash);
  };
  model.on("where", write);
  model.on("search", write);
  if (model.search) write(); // something was set before this component existed
  else history.replaceState({ ...history.state, where: model.where }, "");
  window.addEventListener("popstate", ({ state }) => {
    if (!state?.where) return;
    visiting = state.where;
    model.visited = [(model.visited[0] ?? 0) + 1, visiting];
  }, options);
  model.on("reloads", () => location.reload());
  model.page = location.origin + location.pathname;
}
