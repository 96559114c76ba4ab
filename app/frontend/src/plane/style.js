// The style of Fig. 6, with the tokens of the Lab.
import { shared } from "../controls/style.js";

const own = `
:host { display: block; }
.frame { height: 100%; background: none; }
.plane { height: 100%; display: flex; flex-direction: column; user-select: none; -webkit-user-select: none; }
.plane .titled { flex: none; justify-content: flex-start; gap: 8px 16px; min-height: max(36px, var(--touch)); }
.plane .titled b { flex: 1; } .plane .outline { padding: 4px 12px; min-height: var(--touch); } .titled .outline:first-of-type { margin-left: auto; }
.plot { position: relative; flex: 1; min-height: 0; font-size: var(--t-s); }
.plot svg { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: pan-y; }
.symbol { position: relative; } .symbol i { font: italic 1em Georgia, serif; } .symbol :is(sub, sup) { font-size: .75em; line-height: 0; }
.titled .symbol { color: var(--q-jellett); } .symbol.down { position: absolute; left: 0; font-size: var(--t-m); color: var(--q-routh); }
.symbol.across { position: absolute; right: 0; bottom: 0; color: var(--ink-2); }
.curves path { fill: none; stroke-linejoin: round; }
.curves .lost { fill: color-mix(in srgb, var(--ink) 9%, transparent); } .tielines { stroke: var(--line-2); stroke-width: .8; } .edge { stroke: var(--line-2); }
.curves .force { stroke: var(--q-force); stroke-width: 1.8; } .curves .verge { stroke: var(--ink); stroke-width: 1.4; } .curves .steady { stroke: var(--ink); stroke-width: 1.4; stroke-dasharray: 5 4; }
.card { fill: var(--ground); stroke: var(--line-2); }
.pole { fill: var(--ink); } .lead { stroke: var(--line-2); fill: none; } .half { stroke: var(--line); stroke-dasharray: 2 3; } .touch { stroke: var(--line-2); stroke-dasharray: 2 3; }
.words, .base { pointer-events: none; } svg .sub { font-size: .75em; } svg .i { font-style: italic; font-family: Georgia, serif; }
svg :is(.rolls, .chosen, .K_J, .K_R) > text { font-weight: 600; } svg .lift text { fill: var(--q-force); }
svg .chosen text { fill: var(--accent); } .name.chosen .lead { stroke: var(--accent); } svg .K_J text { fill: var(--q-jellett); } svg .K_R text { fill: var(--q-routh); }
.path .K_J { --own: var(--q-jellett); } .path .K_R { --own: var(--q-routh); }
.path .nods { fill: var(--own); fill-opacity: .2; } .path .nods.beyond { fill-opacity: .1; } .path .goes { fill: none; stroke: var(--own); stroke-width: 2.5; }
.path .goes.beyond { stroke-dasharray: 5 4; } .path .head { fill: var(--own); } .path .last { fill: var(--ground); stroke: var(--own); stroke-width: 2.5; }
.grip { outline: none; } .under, .bar { stroke-linecap: round; } .under { stroke: var(--ground); stroke-width: 10; } .bar { stroke: var(--accent); stroke-width: 6; }
.not .bar { stroke-dasharray: 1 9; } .mark { stroke: var(--ink); stroke-width: 1.4; } .end circle { fill: var(--accent); stroke: var(--ground); }
.bead circle { fill: var(--ground); stroke: var(--accent); stroke-width: 4; }
.grip:focus-visible :is(.bar, circle) { stroke: var(--accent); filter: drop-shadow(0 0 3px var(--accent)) drop-shadow(0 0 1px var(--ink)); } .end:focus-visible circle { stroke-width: 5; }
.line:focus-visible .under { stroke: color-mix(in srgb, var(--accent) 45%, var(--ground)); stroke-width: 14; } .bead:focus-visible circle { stroke: var(--ink); }
.old :is(.base, .path, .inset, .chosen, .words) { opacity: .38; }
`;

export const style = shared + own;
