// The style of the lesson: the question on top, a large picture of the top, and beside it the possible guesses and the
// graph.
import { colours } from "../colours.js";
import { shared, timed } from "../controls/style.js";

const places = `
.frame:focus { outline: 0; } .frame { --head: calc(var(--top, 48px) * var(--type, 1)); scroll-margin-top: var(--head); }
.lesson { display: grid; gap: 10px 24px; padding: 10px 24px 8px; --side: 520px; --stage: clamp(300px, 100vh - 380px, 62cqw);
  grid-template: "crumbs crumbs" auto "question question" auto "stage right" var(--stage) "bar right" auto "more more" auto / minmax(0, 1fr) var(--side); align-content: start; }
.right { grid-area: right; display: flex; flex-direction: column; gap: 12px; min-width: 0; }
.crumbs { grid-area: crumbs; list-style: none; display: flex; flex-wrap: wrap; gap: 0 16px; margin: 0; padding: 0; }
.crumbs button { padding: 0; display: flex; align-items: center; gap: 8px; color: var(--ink-2); min-height: 36px; }
.crumbs b { width: 24px; height: 24px; border-radius: 50%; display: grid; place-items: center; box-shadow: inset 0 0 0 1.5px var(--line-2); font-size: var(--t-s); }
.crumbs .done b { background: var(--ink-2); color: var(--ground); box-shadow: none; }
.crumbs [aria-current] { color: var(--accent); font-weight: 600; } .crumbs [aria-current] b { background: var(--accent); color: var(--ground); box-shadow: none; }
.question { grid-area: question; font-size: 28px; line-height: 1.2; letter-spacing: -.02em; text-wrap: balance; }
.caption, .cover { position: absolute; left: 0; right: 0; text-align: center; color: var(--scene-ink); padding: 0 8px; pointer-events: none; }
.caption { bottom: 14px; font-weight: 600; } .caption svg { display: inline-block; vertical-align: 2px; margin-right: 4px; } .cover { top: 45%; }
.wait { position: absolute; left: 16px; right: 16px; top: 45%; text-align: center; }
.waits :is(.pill, .tops) { visibility: hidden; }
.bar { grid-area: bar; display: grid; grid-template-columns: 48px minmax(0, 1fr); gap: 0 8px; align-items: center; align-content: start; min-width: 0; }
.bar.none { visibility: hidden; }
.bar .plot { height: 108px; } .bar .small { grid-column: 1 / -1; min-height: 1.45em; }
.covered { fill: color-mix(in srgb, var(--ink) 7%, var(--ground)); } svg .covered + .word { font-weight: 400; fill: var(--ink-2); }
.side { display: flex; flex-direction: column; gap: 10px; min-width: 0; }
.picture { min-width: 0; flex: 1; display: flex; flex-direction: column; max-height: 330px; } .picture .plot { flex: 1; min-height: 170px; } .picture h3 { font-size: var(--t-m); font-weight: 600; margin: 0 0 4px; }
.ways { position: absolute; top: 12px; right: 12px; display: grid; gap: 4px; } .ways figure { margin: 0; text-align: center; } .ways svg { width: 76px; height: 76px; margin: 0 auto; } .ways figcaption { font-size: var(--t-s); color: var(--scene-ink); }
.ways .rim { fill: color-mix(in srgb, var(--ground) 75%, transparent); stroke: var(--line-2); } .ways .line { stroke-width: 4; } .tip.own { fill: var(--q-spin); } .tip.turning { fill: var(--ink); }
.axis-name { text-align: right; font-size: var(--t-s); color: var(--ink-2); } .axis-name:empty { display: none; }
.more { grid-area: more; display: flex; flex-wrap: wrap; gap: 0 20px; } .more .link { font-weight: 400; color: var(--ink-2); }
`;

const question = `
fieldset { border: 0; margin: 0; padding: 0; display: grid; gap: 8px; min-width: 0; } legend { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.option { display: flex; align-items: center; gap: 12px; min-height: 48px; padding: 6px 14px; border-radius: 6px; box-shadow: inset 0 0 0 1px var(--line-2); cursor: pointer; }
.option:hover { background: color-mix(in srgb, var(--ink) 4%, transparent); }
.option input { appearance: none; flex: none; width: 20px; height: 20px; margin: 0; border-radius: 50%; box-shadow: inset 0 0 0 1.5px var(--line-2); background: var(--ground); }
.option input:checked { box-shadow: inset 0 0 0 2px var(--accent), inset 0 0 0 5px var(--ground); background: var(--accent); }
.option:has(:checked) { box-shadow: inset 0 0 0 2px var(--accent); background: color-mix(in srgb, var(--accent) 12%, var(--ground)); color: var(--accent); font-weight: 600; }
.option:has(:focus-visible) { outline: 3px solid var(--accent); outline-offset: 2px; } .option input:focus-visible { outline: 0; }
.dock { display: flex; align-items: center; gap: 16px; } .primary:disabled { background: color-mix(in srgb, var(--ink) 12%, var(--ground)); color: var(--ink-2); cursor: default; }
.primary.quiet { background: none; color: var(--ink); box-shadow: inset 0 0 0 1px var(--line-2); } .dock .quiet { order: 1; }
.number { display: grid; gap: 8px; font-weight: 600; } .number input { width: 100%; height: 44px; margin: 0; accent-color: var(--accent); }
.number .unset::-webkit-slider-thumb { opacity: .3; } .number .unset::-moz-range-thumb { opacity: .3; }
.told { display: grid; gap: 8px; } .told:empty { display: none; } .learned { border-left: 4px solid var(--accent); padding-left: 12px; }
.equation { overflow-x: auto; overflow-y: hidden; padding: 4px 0 6px; } .equations { display: grid; gap: 4px; } math { font-family: 'STIX Two Math', 'Cambria Math', 'Latin Modern Math', 'DejaVu Math TeX Gyre', math; }
details > summary { cursor: pointer; min-height: 24px; } details p { margin: 4px 0; }
a.link { color: inherit; justify-self: start; display: flex; align-items: center; min-height: var(--touch); } .end { display: grid; gap: 8px; justify-items: start; } .end:empty { display: none; } .end ol { margin: 0; padding-left: 20px; display: grid; gap: 4px; }
`;

const drawings = `
path.line { fill: none; stroke-width: 2; stroke-linejoin: round; } .first { stroke: var(--line-2); }
svg text.own { fill: var(--q-spin); stroke: none; } svg text { stroke: none; } svg .halo { paint-order: stroke; stroke: var(--ground); stroke-width: 4px; }
.picture .now { stroke: var(--accent); stroke-width: 2; } .mark { fill: var(--ground); stroke: var(--ink); stroke-width: 2; }
.hull { fill: color-mix(in srgb, ${colours.wood} 45%, var(--ground)); stroke: var(--q-energy); } .table { stroke: var(--ink-2); stroke-width: 1.5; } .thin { stroke: var(--line-2); stroke-dasharray: 5 4; fill: none; }
.arm-own, .arm-upright { stroke-width: 5; stroke-linecap: round; fill: none; } .arm-own { stroke: var(--q-spin); } .arm-upright { stroke: var(--ink); } .mass { fill: var(--ink); } .pushed { fill: var(--ground); stroke: var(--ink); stroke-width: 2; }
`;

const present = `
.frame.presenting { position: fixed; inset: 0; z-index: 1400; overflow: auto; }
.board, .foot, .phone-head, .phone-foot, .follows { display: none; }
.lesson.present { --t-m: 24px; --t-s: 18px; --t-l: 30px; --touch: 48px; font-size: var(--t-m); height: max(100vh, 600px); padding: 24px 40px 12px; gap: 16px 40px; --side: 30vw;
  grid-template: "question question" auto "stage board" minmax(0, 1fr) "bar board" auto "foot foot" auto / minmax(0, 1fr) var(--side); }
.present > :is(.crumbs, .right, .more) { display: none; } .present .question { font-size: clamp(32px, 3.1vw, 64px); } .present .stage { height: auto; position: relative; min-height: 240px; }
.present .board { grid-area: board; display: flex; flex-direction: column; gap: 12px; min-height: 0; min-width: 0; overflow: auto; } .present .foot { grid-area: foot; display: flex; justify-content: space-between; align-items: center; gap: 16px; flex-wrap: wrap; font-size: var(--t-s); color: var(--ink-2); }
.letters { list-style: none; margin: 0; padding: 0; display: grid; gap: 10px; } .letters li { display: flex; gap: 16px; } .letters b { width: 1.2em; } .letters span { flex: 1; } .letters .true { color: var(--accent); font-weight: 600; }
.votes { display: flex; align-items: center; gap: 8px; } .votes i { height: 12px; background: var(--ink-2); max-width: 80%; border-radius: 3px; } .letters .true i { background: var(--accent); } .letters em { font-style: normal; font-weight: 600; }
.present > .picture { grid-area: stage; max-height: none; } .lesson.present[data-picture=arms] .stage { visibility: hidden; }
.board .picture { display: none; } [data-answered] .board .picture { display: flex; flex: none; height: 300px; max-height: 34vh; }
.qr { flex: 1 1 0; min-height: min(220px, 23vh); position: relative; } .qr svg { position: absolute; inset: 0; width: 100%; height: 100%; } .link-address { text-align: center; overflow-wrap: anywhere; font-weight: 600; } .link-address:empty, .warning:empty { display: none; }
.warning { border-left: 4px solid var(--ink); padding-left: 12px; } .counted { margin-top: auto; position: sticky; bottom: 0; background: var(--ground); display: flex; align-items: center; justify-content: space-between; gap: 16px; } .count b { font-size: 2em; } .present .primary { min-height: 64px; padding: 0 36px; }
.present .bar .plot { height: 150px; } .keys { display: flex; gap: 4px; flex-wrap: wrap; } .keys button { min-height: 36px; padding: 0 8px; } kbd { font: inherit; border: 1px solid var(--line-2); border-radius: 4px; padding: 0 6px; margin-right: 6px; }
.dots i { display: inline-block; width: 12px; height: 12px; border-radius: 6px; margin-right: 8px; box-shadow: inset 0 0 0 1.5px var(--line-2); } .dots .here { width: 32px; background: var(--accent); box-shadow: none; }
.lesson[data-role=phone] { display: flex; flex-direction: column; gap: 8px; padding: 0; --stage: 280px; min-height: var(--page, 100svh); } .lesson[data-role=phone] > :is(.crumbs, .more, .bar) { display: none; } .lesson[data-role=phone] :is(.dock, .picture, .end) { display: none; } .lesson[data-role=phone] .right { display: contents; }
.lesson[data-role=phone][data-picture=arms] .picture { display: flex; order: 1; flex: none; height: var(--stage); padding: 8px 16px; }
.lesson[data-role=phone] .stage { order: 1; height: var(--stage); flex: none; } .lesson[data-role=phone] :is(.phone-head, .phone-foot) { display: flex; align-items: center; gap: 12px; padding: 8px 16px; }
.lesson[data-role=phone] .phone-head { order: 0; position: relative; height: 48px; padding: 0 16px; margin-bottom: -8px; } .lesson[data-role=phone] .question { order: 2; font-size: 20px; padding: 0 16px; } .lesson[data-role=phone] .side { display: flex; order: 3; padding: 0 16px; } .lesson[data-role=phone] .side > * { padding: 0; }
.lesson[data-role=phone] .phone-foot { order: 4; flex-direction: column; align-items: stretch; } .phone-head b { font-size: 18px; } .phone-head .round { position: absolute; right: 12px; top: calc(48px + var(--stage) - 60px); z-index: 3; font-size: 20px; }
.lesson[data-role=phone] .hint { color: var(--ink-2); } .lesson[data-role=phone] .option { min-height: 52px; } .lesson[data-role=phone] .option:has(:checked)::after { content: var(--sent, none); margin-left: auto; white-space: nowrap; }
.lesson[data-role=phone] .follows { order: 9; display: flex; align-items: center; justify-content: space-between; gap: 16px; margin-top: auto; position: sticky; bottom: 0; z-index: 4; min-height: 60px; padding: 0 16px; background: var(--ground); border-top: 1px solid var(--line); } .follows a { color: inherit; font-weight: 600; text-decoration: none; display: flex; align-items: center; min-height: 44px; }
.lesson.empty > :is(.stage, .side, .question) { display: none !important; }
`;

const steps = `
.steps .picture { max-height: none; padding: 0; } .steps .picture .plot { height: 260px; flex: none; }
.step { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 12px; margin: 8px 0; } .step span { flex-basis: 100%; } .steps a { color: var(--accent); } .step input { flex: 1; min-width: 120px; min-height: var(--touch); accent-color: var(--accent); } .step output { min-width: 4em; font-weight: 600; }
.steps ul { list-style: none; margin: 0; padding: 0; display: grid; gap: 4px; } .steps li { display: flex; gap: 8px; align-items: baseline; } .steps .swatch { flex: none; width: 26px; height: 8px; }
`;

const small = `
@container (min-width: 1500px) { .lesson { --t-s: 16px; --t-m: 18px; --t-l: 24px; --touch: 44px; --side: 640px; font-size: var(--t-m); } .question { font-size: 38px; } .picture { max-height: 420px; } }
@container (max-width: 1180px) { .lesson { --side: 400px; gap: 10px 16px; padding: 8px 16px; } .question { font-size: 24px; } }
@container (max-width: 700px) {
  .lesson { --touch: 44px; --stage: clamp(160px, 100vh - 648px, 236px); display: flex; flex-direction: column; gap: 6px; padding: 0 0 8px; }
  .right, .side { display: contents; } .lesson > :not(.stage), .side > *, .picture { padding: 0 16px; } .crumbs { justify-content: flex-end; gap: 0 4px; padding: 4px 12px !important; } .crumbs span { display: none; } .crumbs button { min-height: 40px; min-width: 32px; justify-content: center; }
  .stage { order: 1; height: var(--stage) !important; flex: none; border-radius: 0; position: sticky !important; top: var(--head) !important; z-index: 2; } .crumbs { order: 0; }
  .bar { order: 2; position: relative; grid-template-columns: minmax(0, 1fr); } .bar .plot { height: 76px; } .bar .round { position: absolute; right: 12px; top: -60px; z-index: 3; }
  .lesson[data-picture=arms]:not(.present) .stage { display: none; }
  .lesson[data-picture=arms]:not(.present) .bar .round { top: calc(-4px - var(--stage)); }
  .picture { order: 6; flex: none; } [data-picture=arms] .picture { order: 1; position: sticky; top: var(--head); z-index: 2; background: var(--ground); } [data-picture=arms] .picture .plot { height: calc(var(--stage) - 28px); } .picture .plot { flex: none; height: 132px; min-height: 0; } .question { order: 3; font-size: 20px; } .side > * { order: 4; } .side > .dock { order: 8; } .more { order: 7; }
  .side :is(input, button, a) { scroll-margin: calc(var(--head) + var(--stage) + 16px) 0 84px; }
  .side > .dock { position: sticky; bottom: 0; z-index: 5; background: var(--ground); border-top: 1px solid var(--line); padding: 8px 16px; } .primary { min-height: 44px; }
  .caption { bottom: auto; top: 4px; font-size: var(--t-s); padding: 0 4px; line-height: 1.2; } .cover { top: 52%; font-size: var(--t-s); } .ways { top: 6px; left: 6px; right: 6px; display: flex; justify-content: space-between; } .ways figure { width: 84px; } .ways svg { width: 60px; height: 60px; } .ways figcaption { line-height: 1; }
}
`;

export const style = [shared, timed, places, question, drawings, present, steps, small].join("");
