// The style sheet of the derivation's lines.
export const style = `
.lines { font: calc(14px * var(--type, 1))/1.45 var(--family, system-ui, sans-serif); color: var(--ink) }
.line { border-top: 1px solid var(--rule); padding: 7px 0 }
.line > .head { display: flex; gap: 8px; align-items: baseline; }
.eq { overflow-x: auto; overflow-y: hidden; font-size: 1.07em; padding: 3px 0; min-width: 0 }
math { font-family: 'STIX Two Math', 'Cambria Math', 'Latin Modern Math', 'DejaVu Math TeX Gyre', math }
button { font: inherit; background: none; border: 1px solid var(--control-line); border-radius: 6px; color: var(--link);
  padding: 1px 7px; cursor: pointer; min-width: 46px }
button[aria-expanded=true] { background: var(--accent); color: var(--card) }
.sides { color: var(--faint); font-size: 0.9em; font-variant-numeric: tabular-nums;
  overflow-wrap: anywhere }
.sides b { font-weight: 600; color: var(--ink) }
.known { cursor: help; color: var(--link) } .known:hover { background: color-mix(in srgb, var(--link) 14%, var(--card)) }
.symbols { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 230px), 1fr)); gap: 4px;
  margin-top: 5px; font-size: calc(12px * var(--type, 1)) } .symbols[hidden] { display: none }
.symbols div { border-radius: 6px; padding: 2px 6px;
  background: color-mix(in srgb, var(--ink) 6%, var(--card)) }
.symbols div:focus { outline: 2px solid var(--link) }
.tip { position: fixed; z-index: 99; pointer-events: none; background: var(--ink); color: var(--card); border-radius: 6px;
  padding: 4px 8px; font-size: calc(12px * var(--type, 1)); max-width: 280px }
`;
