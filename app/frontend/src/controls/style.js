// The style of everything that a hand sets: sizes, and short names for tokens.js; buttons and choices; number controls. Four
// font sizes, a grid of 8 px, one blue for what is selected, one colour for each quantity.
const tokens = `
.frame { --t-s: 12px; --t-m: 14px; --t-l: 18px; --touch: 32px; --side: 440px; --gap: 24px; --bar: 148px;
  --ground: var(--card); --floor: var(--scene); --ink-2: var(--faint); --line: var(--rule); --line-2: var(--control-line);
  --q-spin: var(--omega); --q-energy: var(--energy); --q-energy-wash: var(--energy_wash); --q-jellett: var(--jellett); --q-routh: var(--routh); --q-force: var(--normal);
  container-type: inline-size; background: var(--ground); color: var(--ink); font: 400 var(--t-m)/1.45 var(--family);
  -webkit-font-smoothing: antialiased; }
.frame[data-large] { --t-s: 16px; --t-m: 18px; --t-l: 24px; --touch: 44px; --bar: 176px; }
`;

const basics = `
* { box-sizing: border-box; }
[hidden] { display: none !important; }
h2, p { margin: 0; } h2 { font-size: var(--t-m); font-weight: 600; }
b { font-weight: 600; }
.big { font-size: var(--t-l); font-weight: 600; letter-spacing: -.01em; line-height: 1.3; }
.small { font-size: var(--t-s); color: var(--ink-2); }
button, select, input { font: inherit; color: inherit; }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; border-radius: 6px; }
button { min-height: var(--touch); border: 0; background: none; border-radius: 6px; padding: 0 12px; cursor: pointer; }
button:hover { background: color-mix(in srgb, var(--ink) 7%, transparent); }
select { border: 0; background: none; min-height: var(--touch); padding: 0 4px; border-radius: 6px; cursor: pointer; }
select option { color: var(--ink); background: var(--ground); }
.primary, .round { background: var(--ink); color: var(--ground); font-weight: 600; }
.primary { padding: 0 20px; min-height: 40px; white-space: nowrap; }
.primary:hover, .round:hover { background: color-mix(in srgb, var(--ink) 85%, var(--ground)); }
.round { width: 48px; height: 48px; padding: 0; border-radius: 50%; display: grid; place-items: center; }
.round:focus-visible { border-radius: 50%; }
.outline { padding: 8px 16px; box-shadow: inset 0 0 0 1px var(--line-2); text-align: left; line-height: 1.3; }
.outline span { display: block; font-size: var(--t-s); color: var(--ink-2); }
.outline.word { min-width: 76px; text-align: center; padding: 0 12px; }
.link { min-height: 28px; padding: 0 2px; text-decoration: underline; text-underline-offset: 3px; text-decoration-color: var(--line-2); font-weight: 600; }
.titled { display: flex; align-items: center; justify-content: space-between; min-height: 32px; gap: 8px; }
.seg { display: inline-flex; gap: 2px; }
.seg button { min-height: calc(var(--touch) - 4px); padding: 0 12px; border-radius: 5px; color: var(--ink-2); white-space: nowrap; }
.seg [aria-checked=true] { background: var(--ground); color: var(--accent); font-weight: 600; box-shadow: 0 0 0 1.5px var(--accent); }
.mini { display: flex; gap: 12px; align-items: baseline; }
.mini button { padding: 0; min-height: max(28px, var(--touch) - 4px); min-width: 28px; color: var(--ink-2); }
.mini [aria-selected=true] { color: var(--accent); font-weight: 600; box-shadow: 0 2px 0 var(--accent); border-radius: 0; }
svg { display: block; overflow: visible; }
svg text { font: 400 var(--t-s) var(--family); fill: var(--ink-2); }
svg .word { font-weight: 600; fill: var(--ink); }
svg .halo { paint-order: stroke; stroke: var(--ground); stroke-width: 4px; stroke-linejoin: round; }
svg .axis { stroke: var(--line-2); fill: none; } svg .grid { stroke: var(--line); }
polyline, .rest, .past { fill: none; stroke-linejoin: round; }
`;

export const numbers = `
.picks { display: none; }
.ctl { display: grid; grid-template-columns: 1fr auto; align-items: baseline; column-gap: 8px; }
.ctl label { font-weight: 600; }
.num { width: 72px; border: 0; border-bottom: 1px solid var(--line-2); background: none; padding: 0; height: 24px; border-radius: 0; text-align: right; font-variant-numeric: tabular-nums; }
.num:focus-visible { outline-offset: 0; }
.unit { color: var(--ink-2); margin-left: 4px; display: inline-block; min-width: 4ch; }
.ctl > :is(.ticks, .below, .wrong) { grid-column: 1 / -1; }
.ctl input[type=range] { grid-column: 1 / -1; -webkit-appearance: none; appearance: none; width: 100%; height: 24px; margin: 0; background: none; cursor: pointer; }
.ctl input::-webkit-slider-runnable-track { height: 4px; border-radius: 2px; background: linear-gradient(90deg, var(--accent) var(--p, 50%), var(--line-2) var(--p, 50%)); }
.ctl input::-moz-range-track { height: 4px; border-radius: 2px; background: linear-gradient(90deg, var(--accent) var(--p, 50%), var(--line-2) var(--p, 50%)); }
.ctl input::-webkit-slider-thumb { -webkit-appearance: none; width: 20px; height: 20px; margin-top: -8px; border-radius: 50%; background: var(--ground); border: 5px solid var(--accent); }
.ctl input::-moz-range-thumb { box-sizing: border-box; width: 20px; height: 20px; border-radius: 50%; background: var(--ground); border: 5px solid var(--accent); }
.bad .num { border-bottom: 3px solid var(--ink); font-weight: 600; }
.wrong { display: flex; gap: 8px; margin-top: 4px; line-height: 1.4; }
.wrong .mark { flex: none; width: 20px; height: 20px; border-radius: 50%; background: var(--ink); color: var(--ground); display: grid; place-items: center; font-size: var(--t-s); }
`;

// A stage with tops side by side, and below it a line of time.
export const timed = `
.stage { grid-area: stage; position: relative; background: var(--floor); border-radius: 6px; overflow: hidden; min-width: 0; }
.tops { position: absolute; inset: 0; display: flex; } .place { flex: 1 1 0; min-width: 0; position: relative; } .top { position: absolute; inset: 0; }
.pill { position: absolute; left: 16px; bottom: 12px; background: var(--ground); border-radius: 16px; padding: 4px 12px; font-weight: 600; font-variant-numeric: tabular-nums; }
.plot { position: relative; } .plot svg { position: absolute; inset: 0; width: 100%; height: 100%; } .event { stroke: var(--line-2); stroke-dasharray: 2 3; }
.timeline .plot { cursor: pointer; touch-action: pan-y; user-select: none; }
.timeline .rest { stroke: var(--line-2); stroke-width: 1.5; } .timeline .past { stroke: var(--ink); stroke-width: 2.2; }
.timeline .now { position: absolute; left: -1px; top: 10px; bottom: 22px; width: 2px; background: var(--accent); pointer-events: none; }
.timeline .head { position: absolute; left: -10px; bottom: 12px; width: 20px; height: 20px; border-radius: 50%; background: var(--ground); border: 5px solid var(--accent); pointer-events: none; }
.at { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; pointer-events: none; } .at:focus-visible ~ .head { outline: 3px solid var(--accent); outline-offset: 2px; }
.spins { fill: var(--q-energy-wash); } .lifts { fill: var(--q-energy); } .own { stroke: var(--q-spin); } .turning { stroke: var(--ink); } .energy { stroke: var(--q-energy); }
@container (max-width: 700px) { .timeline .head { width: 28px; height: 28px; left: -14px; bottom: 8px; border-width: 6px; } }
`;

// How far something is that takes a while.
export const progress = `.wait progress { -webkit-appearance: none; appearance: none; width: 110px; height: 6px; border: 0; border-radius: 3px; overflow: hidden; background: var(--line); }
.wait progress::-webkit-progress-bar { background: var(--line); } .wait progress::-webkit-progress-value { background: var(--ink); } .wait progress::-moz-progress-bar { background: var(--ink); }
`;

// What Share offers: a title and a sentence, and its buttons beside them.
export const offer = `.all { display: flex; flex-flow: row wrap; align-items: center; gap: 8px; } .all > * { flex: 1 1 100%; } .all > .says { flex: 1 1 150px; } .says b { display: block; }
.all > :is(.wait, .outline) { flex: none; }
`;

// A text to copy.
export const toCopy = `textarea { font: var(--t-s)/1.5 ui-monospace, monospace; padding: 8px; border: 1px solid var(--line-2); border-radius: 6px; color: inherit; background: none; resize: none; min-width: 0; }
`;

// A choice with buttons on a ground of its own.
export const segments = `.seg { flex-wrap: wrap; background: color-mix(in srgb, var(--ink) 7%, var(--ground)); border-radius: 8px; padding: 3px; }
`;

// What stands at the foot of a narrow page: one number control at a time, and a button for each.
export const dock = `.dock { position: sticky; bottom: 0; background: var(--ground); border-top: 1px solid var(--line); padding: 4px 16px 8px; }
  .dock .picks { display: flex; gap: 4px; margin-left: -8px; }
  .picks button { padding: 0 8px; min-height: 44px; line-height: 1.15; text-align: left; color: var(--ink-2); font-size: var(--t-s); border-radius: 0; }
  .picks b { display: block; font-size: var(--t-m); color: var(--ink); font-variant-numeric: tabular-nums; white-space: nowrap; }
  .picks [aria-pressed=true], .picks [aria-pressed=true] b { color: var(--accent); font-weight: 600; }
  .picks [aria-pressed=true] { box-shadow: inset 0 -3px 0 var(--accent); }
  .dock .ctl:not(.picked), .dock label { display: none; }
  .dock .ctl > span { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
  .dock .ctl.bad > span { position: static; width: auto; height: auto; clip-path: none; grid-column: 1 / -1; }`;

// A thumb for a finger, where the page is narrow.
export const forFingers = `.ctl input[type=range] { height: 44px; margin: -2px 0 -10px; }
  .ctl input::-webkit-slider-thumb { width: 28px; height: 28px; margin-top: -12px; border-width: 6px; }`;

export const shared = tokens + basics;
