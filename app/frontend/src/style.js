// One style sheet for both pictures. Text and lines use the colour of the page, so a dark page needs no second sheet.
import { colours } from "./colours.js";
import { part } from "./parts.js";

export const style = `
:host { --line: color-mix(in srgb, currentColor 18%, transparent); }
.tippe { display: flex; flex-direction: column; width: 100%; height: 100%; min-height: 300px; box-sizing: border-box;
  font: calc(14px * var(--type, 1))/1.35 var(--family, system-ui, sans-serif); }
.picture { position: relative; flex: 1 1 auto; min-height: 220px; overflow: hidden; border-radius: 10px; background: var(--scene); }
.picture canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; outline: none; cursor: grab; }
.picture canvas:active { cursor: grabbing; }
.picture canvas:focus-visible { outline: 2px solid var(--focus); outline-offset: -2px; }
.picture:not([data-drawn]) .labels { visibility: hidden; }
.labels { position: absolute; inset: 0; overflow: hidden; pointer-events: none; color: var(--scene-ink); }
.labels span { position: absolute; left: 0; top: 0; white-space: nowrap; will-change: transform; }
.labels .vector { font: italic 600 calc(18px * var(--type, 1))/1 Georgia, serif;
  text-shadow: 0 0 3px var(--halo), 0 0 3px var(--halo), 0 0 5px var(--halo); }
.labels .tick { font-size: calc(12px * var(--type, 1)); font-variant-numeric: tabular-nums; color: var(--scene-faint); }
.labels .axis { font: calc(14px * var(--type, 1))/1 Georgia, serif; }
.labels .axis :is(sub, sup) { font-size: 75%; line-height: 0; }
.labels .point { font: 600 calc(14px * var(--type, 1))/1 Georgia, serif; text-shadow: 0 0 3px var(--halo), 0 0 4px var(--halo); }
.labels .handle { width: 24px; height: 24px; border-radius: 50%; box-sizing: border-box; background: #fff; border: 5px solid var(--accent);
  box-shadow: 0 1px 4px #0006; cursor: grab; pointer-events: auto; touch-action: none; }
@media (hover: hover) { .labels .handle::before { content: ""; position: absolute; inset: -24px; border-radius: 50%; } } /* reached without aiming */
.labels .handle.moves:not(:hover, :focus-visible, :active) { opacity: 0; }
@media not (prefers-reduced-motion) { .labels .handle:not(.moves, .found) { animation: pulse 1.2s 1s 2; } }
@keyframes pulse { 50% { box-shadow: 0 0 0 14px color-mix(in srgb, var(--accent) 30%, transparent); } }
.labels .handle:active { cursor: grabbing; }
.labels .handle:active::after { content: attr(data-wording); position: absolute; left: 28px; top: -16px; padding: 2px 8px; border-radius: 999px;
  font-weight: 600; background: var(--pill); color: var(--scene-ink); }
.labels .handle:focus-visible { outline: 3px solid var(--scene-ink); outline-offset: 2px; }
.note { position: absolute; inset: auto 12px 12px; margin: 0; padding: 8px 12px; border-radius: 8px; background: var(--pill);
  color: var(--scene-ink); box-shadow: 0 1px 4px #0003; }
.verdict { position: absolute; left: 12px; bottom: 44px; display: flex; align-items: center; gap: 7px; padding: 5px 12px 5px 9px;
  border-radius: 999px; font-weight: 600; background: var(--pill); color: var(--scene-ink); box-shadow: 0 1px 3px #0002; pointer-events: none; }
.verdict::before { content: ""; width: 10px; height: 10px; border-radius: 50%; background: var(--verdict); }
.scales { position: absolute; right: 12px; top: 12px; text-align: right; line-height: 1.5; font-size: calc(12px * var(--type, 1)); color: var(--scene-faint); pointer-events: none; }
.bar { flex: none; display: flex; flex-wrap: wrap; align-items: center; gap: 6px 8px; padding: 8px 2px 0; }
.bar :is(button, select) { font: inherit; color: inherit; background: transparent; border: 0; border-radius: 6px; min-height: 36px; min-width: 36px; padding: 0 6px; cursor: pointer; display: inline-grid; place-items: center; }
.bar :is(button, select):hover { background: color-mix(in srgb, currentColor 8%, transparent); } .bar select option { background: var(--card); }
.bar button.play { width: 48px; height: 48px; border-radius: 50%; background: var(--ink); color: var(--card); }
.bar :is(button, select, input):focus-visible { outline: 3px solid var(--focus); outline-offset: 2px; }
.bar .scrub { flex: 1 1 160px; min-width: 120px; accent-color: var(--focus); height: 36px; margin: 0; cursor: pointer; }
.time { position: absolute; left: 12px; bottom: 10px; padding: 4px 11px; border-radius: 999px; background: var(--pill); color: var(--scene-ink);
  font-variant-numeric: tabular-nums; white-space: nowrap; box-shadow: 0 1px 3px #0002; pointer-events: none; }
.time sup, .scales sup { font-size: 75%; line-height: 0; } .scales i { font-family: Georgia, serif; }
.bar .shows { display: flex; flex-wrap: wrap; gap: 5px; }
.bar .shows label { display: inline-flex; align-items: center; gap: 5px; padding: 0 8px; height: 26px; border-radius: 999px; font-size: calc(12px * var(--type, 1));
  border: 1px solid var(--line); cursor: pointer; white-space: nowrap; user-select: none; }
.bar .shows label:not(:has(input:checked)) { opacity: 0.75; border-style: dashed; }
.bar .shows input { position: absolute; opacity: 0; width: 1px; height: 1px; }
.bar .shows label:has(input:focus-visible) { outline: 2px solid var(--focus); outline-offset: 2px; }
.bar .swatch { width: 11px; height: 11px; border-radius: 3px; background: var(--swatch); }
.bar .shows label:not(:has(input:checked)) .swatch { background: transparent; box-shadow: inset 0 0 0 2px var(--swatch); }
.key { flex: none; display: flex; flex-wrap: wrap; gap: 2px 14px; padding: 6px 2px 0; font-size: calc(12px * var(--type, 1)); color: var(--faint); }
.key span::before { content: ""; display: inline-block; width: 16px; height: 3px; margin: 0 6px 3px 0; vertical-align: middle;
  background: var(--swatch); }
.key sub { font-size: 75%; line-height: 0; }
@media (max-width: 700px) {
  .scales { display: none; }
  .tippe { min-height: 0; } .picture { min-height: 140px; } .bar { flex-wrap: nowrap; } .bar .scrub { flex: 1 1 40px; min-width: 40px; } .bar select { max-width: 104px; } .bar .view { display: none; }
  .bar :is(button, select, .scrub) { min-height: 44px; } .bar .shows label { height: 36px; }
  .bar:has(.shows) { flex-wrap: wrap; } .bar .shows { flex: 1 0 100%; flex-wrap: nowrap; overflow-x: auto; }
}
`;

// Creates what both components need: a style sheet, and a box for the picture.
/** @param {HTMLElement} el */
export function frameIn(el) {
  const picture = part("div", { class: "picture" }), root = part("div", { class: "tippe" }, picture);
  el.replaceChildren(part("style", {}, style), root);
  return { root, picture };
}

export const guideStyle = `
:host { font: calc(14px * var(--type, 1))/1.45 var(--family, system-ui, sans-serif); display: flex; gap: 4px; align-items: center; }
[hidden] { display: none !important; }
button { font: inherit; color: inherit; background: transparent; border: 1px solid currentColor; border-radius: 6px; cursor: pointer;
  min-width: 34px; height: calc(34px * var(--type, 1)); padding: 0 10px; }
button:hover { background: color-mix(in srgb, currentColor 12%, transparent); }
button:focus-visible { outline: 2px solid currentColor; outline-offset: 2px; } h2 { outline: none; }
dialog, .stop { color: var(--ink); background: var(--card); border: 1px solid var(--control-line); border-radius: 10px; padding: 14px 18px;
  box-shadow: 0 6px 24px #0006; box-sizing: border-box; max-width: min(560px, calc(100vw - 28px)); }
dialog::backdrop { background: #0008; }
h2 { font-size: calc(18px * var(--type, 1)); margin: 0 0 6px; outline-offset: 4px; } h3 { font-size: 1em; margin: 14px 0 4px; }
table { border-collapse: collapse; margin: 0 0 12px; } th, td { text-align: left; padding: 4px 14px 4px 0; vertical-align: top; font-weight: normal; } th { font-weight: 600; }
.stop { position: fixed; z-index: 3000; width: min(320px, calc(100vw - 28px)); } .stop p { margin: 0 0 10px; }
.stop div { display: flex; align-items: center; gap: 8px; } .stop .count { flex: 1; color: var(--faint); }
.stop .next { background: ${colours.accent}; border-color: ${colours.accent}; color: #fff; }
.ring { position: fixed; z-index: 2999; border: 3px solid ${colours.accent}; border-radius: 10px; box-sizing: border-box; pointer-events: none; box-shadow: 0 0 0 2px #fff; }
`;
