// The style of the head: one row of 48 px in the colour of the background; what is selected is blue.

export const headStyle = `
:host { position: sticky; top: 0; z-index: 20; } .all { width: 100%; }
* { box-sizing: border-box; } [hidden] { display: none !important; }
.row, .rooms { --ground: var(--card); color: var(--ink); background: var(--ground);
  font: calc(14px * var(--type, 1))/1.45 var(--family, system-ui, sans-serif); }
.row { display: flex; align-items: center; gap: 16px; height: calc(48px * var(--type, 1)); padding: 0 24px; border-bottom: 1px solid var(--rule); }
h1 { font-size: calc(18px * var(--type, 1)); font-weight: 600; margin: 0; letter-spacing: -.01em; white-space: nowrap; }
.grow { flex: 1; } .after { display: contents; } .session, .session span { display: flex; align-items: center; } .session { gap: 16px; }
button, select, input { font: inherit; color: inherit; }
button { min-height: calc(32px * var(--type, 1)); border: 0; background: none; border-radius: 6px; padding: 0 12px; cursor: pointer; white-space: nowrap; }
button:hover { background: color-mix(in srgb, currentColor 8%, transparent); } button:disabled { opacity: .55; cursor: default; background: none; }
:focus-visible { outline: 3px solid var(--accent); outline-offset: -2px; border-radius: 6px; }
[aria-expanded=true]:not(.icon) { color: var(--accent); font-weight: 600; box-shadow: 0 0 0 1.5px var(--accent); }
.icon { width: calc(32px * var(--type, 1)); padding: 0; }
select { border: 0; background: var(--ground); min-height: calc(32px * var(--type, 1)); padding: 0 4px; border-radius: 6px; cursor: pointer; min-width: 0; max-width: 240px; text-overflow: ellipsis; }
.tabs { display: flex; gap: 4px; } .tabs button { color: var(--faint); min-height: calc(48px * var(--type, 1)); border-radius: 0; position: relative; }
.tabs [aria-selected=true] { color: var(--accent); font-weight: 600; }
.tabs [aria-selected=true]::after { content: ""; position: absolute; left: 12px; right: 12px; bottom: 0; height: 3px; background: var(--accent); }
.switch { display: inline-flex; justify-self: start; gap: 2px; padding: 3px; border-radius: 8px; background: color-mix(in srgb, var(--ink) 7%, var(--ground)); }
.switch button { min-height: calc(28px * var(--type, 1)); border-radius: 5px; color: var(--faint); }
.switch [aria-checked=true] { background: var(--ground); color: var(--accent); font-weight: 600; box-shadow: 0 0 0 1.5px var(--accent); }
.row[data-tab=learn] .session .switch { display: none; }
.rooms { padding: 12px 24px 0; }
.menu { position: absolute; display: grid; } .after:has(+ [aria-expanded=false]) .menu { display: none; }
.after, .menu { right: 16px; top: calc(100% + 4px); gap: 8px; padding: 12px; border-radius: 8px; background: var(--card);
  border: 1px solid var(--rule); box-shadow: 0 6px 24px #0004; }
.menu label { display: flex; gap: 8px; align-items: center; min-height: calc(32px * var(--type, 1)); padding: 0 12px; cursor: pointer; } .menu > button { text-align: left; }
.menu input { width: 18px; height: 18px; margin: 0; accent-color: var(--accent); }
@media (max-width: 1150px) { .row { gap: 8px; padding: 0 12px; } .session { gap: 8px; } .tabs { gap: 0; } .tabs button { padding: 0 8px; } .tabs [aria-selected=true]::after { left: 8px; right: 8px; } .session button { padding: 0 10px; } .session .icon { padding: 0; } }
@media (max-width: 940px) { /* all of it is in the menu */
  .after { position: absolute; display: grid; } .after:has(+ [aria-expanded=false]) { display: none; } .after .menu { display: contents; }
  .session { flex-direction: column; align-items: start; }
}
@media (max-width: 700px) {
  .row { padding: 0 4px 0 16px; } .toy { flex: 1; max-width: none; } .row > .grow { display: none; } .icon, .after button, .after label { min-height: 44px; } .icon { width: 44px; }
  nav { position: fixed; inset: auto 0 0; z-index: 20; background: var(--ground); border-top: 1px solid var(--rule); padding-bottom: env(safe-area-inset-bottom); }
  .tabs { display: grid; grid-auto-flow: column; grid-auto-columns: 1fr; } .tabs button { padding: 0 2px; min-height: 52px; font-size: calc(12px * var(--type, 1)); }
  .tabs [aria-selected=true]::after { inset: 0 4px auto; } .rooms { padding: 8px 12px 0; overflow-x: auto; } .rooms button { white-space: normal; padding: 4px 10px; }
}
`;
