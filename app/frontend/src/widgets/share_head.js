// The first part of Share: the link, a button to copy it, and its QR code, which can fill the screen of a lecture hall.
import { copyButton } from "./copy.js";
import { frame } from "../controls/frame.js";
import { follow } from "../life.js";
import { part } from "../parts.js";

const CODE = "background: white; padding: 0; line-height: 0";
const STYLE = `
:host { display: block; max-height: none !important; }
.line { display: flex; align-items: center; gap: 8px; } .line :is(h2, p) { flex: 1; } h2 { font-size: var(--t-l); letter-spacing: -.01em; }
input { flex: 1; min-width: 0; background: none; border: 0; border-bottom: 1px solid var(--ink-2); border-radius: 0; height: 40px; padding: 0 2px; text-overflow: ellipsis; }
.primary { min-width: 150px; } .fill { font-size: var(--t-s); font-weight: 600; white-space: nowrap; } .close { width: var(--touch); padding: 0; }
.code { width: min(100%, clamp(260px, 100vh - 490px, 560px)); margin: 12px auto; ${CODE}; } .code svg, .room svg { width: 100%; height: auto; shape-rendering: crispEdges; }
.room { border: 0; padding: 0; width: 100vw; height: 100vh; max-width: none; max-height: none; background: white; color: black; }
.room[open] { display: grid; grid-template-rows: 1fr auto; justify-items: center; } .room div { width: min(96vw, 100vh - 96px); ${CODE}; }
.room p { font: 600 min(28px, 4vw)/1.3 system-ui, sans-serif; padding: 0 24px 16px; overflow-wrap: anywhere; text-align: center; } .room button { position: fixed; top: 8px; right: 8px; font-size: 18px; }
@media (max-width: 700px) { .primary { min-width: 120px; padding: 0 12px; } }
`;

// Ignore keys that are meant for something above the page, such as a list or a dialog.
const elsewhere = (event) => event.composedPath().some((each) => each instanceof Element && each.matches("dialog, [role=dialog], [role=listbox], .menu"));

/** @param {Rendering<ShareHeadModel>} rendering */
export function renderShareHead(rendering) {
  const { model, el } = rendering, { texts } = model;
  /** @type {Element | null | undefined} */
  let before;
  const opened = () => (before = document.activeElement?.shadowRoot?.activeElement);
  const close = () => {
    model.closed += 1;
    if (before instanceof HTMLElement) before.focus();
  };
  const link = part("input", { readonly: true, spellcheck: "false", "aria-label": texts.link, onfocus: () => link.select() });
  const code = part("div", { class: "code" }), [first, rest] = [0, 1].map(() => part("p", { class: "small", role: "status" }));
  const room = part("dialog", { class: "room", "aria-label": texts.code, onclose: () => room.replaceChildren() });
  const fill = part("button", { type: "button", class: "fill", onclick: () => {
    const large = part("div");
    large.innerHTML = model.picture;
    room.replaceChildren(large, part("p", {}, model.link.replace(/^https?:\/\//, "")), part("button", { type: "button", "aria-label": texts.close, onclick: () => room.close() }, "✕"));
    room.showModal();
  } }, texts.fill);
  const life = frame(rendering, STYLE, part("section", { "aria-label": texts.title },
    part("div", { class: "line" }, part("h2", {}, texts.title), part("button", { type: "button", class: "close", "aria-label": texts.close, title: texts.close, onclick: close }, "✕")),
    part("div", { class: "line" }, link, copyButton(link, "primary", [texts.copy, texts.copied])), code, part("div", { class: "line" }, first, fill), rest), room);
  follow(model, ["link", "picture", "wording"], () => {
    link.value = model.link;
    code.innerHTML = model.picture;
    code.hidden = fill.hidden = !model.picture;
    [first.textContent, rest.textContent] = [model.wording[0] ?? "", model.wording.slice(1).join(" ")];
  });
  model.on("opened", opened);
  opened();
  window.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && el.getClientRects().length && !elsewhere(event)) close();
  }, { signal: life });
}
