// The Lab's style. The layout depends on the width of the Lab, not of the window.
import { dock, forFingers, numbers, progress, shared, timed } from "../controls/style.js";
import { endRules } from "../ends.js";

// The layout: the top and the answer side by side, the bar that controls the time directly below the top, which stays where
// it is when the research opens beside it.
const places = `
.lab { display: grid; gap: 12px var(--gap); padding: 12px var(--gap) 8px; align-content: start;
  --stage: clamp(390px, var(--page, 100vh) - 322px, 62cqw);
  grid-template: "stage answer" calc(var(--stage) - 150px) "stage controls" 138px "strip controls" var(--bar) "say controls" auto / minmax(0, 1fr) var(--side); }
.strip { grid-area: strip; min-width: 0; } .say { grid-area: say; min-width: 0; } .answer { grid-area: answer; min-width: 0; }
.controls { grid-area: controls; min-width: 0; } .keeps { grid-area: answer; min-width: 0; display: none; overflow-x: auto; }
.lab[data-table=three] { --stage: clamp(300px, var(--page, 100vh) - 482px, 40cqw);
  grid-template: "stage stage" var(--stage) "strip strip" var(--bar) "say answer" auto "controls answer" auto / var(--side) minmax(0, 1fr); }
.lab[data-table=three] .answer { display: none; } .lab[data-table=three] .keeps { display: block; }
.lab[data-table=three] .body { display: none; }
.lab[data-table=three] .say .outline { display: none; }
@container (min-width: 1181px) { /* the one slider beside its button */
  .lab[data-table=three] .dock { grid-template-columns: 1fr auto; align-items: center; gap: 24px; } .lab[data-table=three] .dock .titled { display: contents; }
  .lab[data-table=three] .dock h2 { display: none; } .lab[data-table=three] .launch { order: 1; }
}
/* With the research beside it, all is below the top. */
.lab[data-level=research]:not([data-table=three]) { grid-template: "stage stage" var(--stage) "strip strip" var(--bar) "say say" auto "controls answer" auto / minmax(0, 1fr) minmax(0, 1fr);
  --stage: clamp(300px, var(--page, 100vh) - 560px, 62cqw); }
.lab[data-level=research] .answer { min-height: 300px; }
@media (min-width: 1200px) { .lab.lab[data-level=research] { padding-left: 24px; } }
@container (min-width: 1500px) {
  .lab { --t-s: 16px; --t-m: 18px; --t-l: 24px; --touch: 44px; --side: 576px; --gap: 32px; --bar: 176px; font-size: var(--t-m);
    --stage: clamp(390px, var(--page, 100vh) - 400px, 62cqw); }
  .lab[data-table=three] { --stage: clamp(300px, var(--page, 100vh) - 572px, 40cqw); } .frame[data-large] .lab[data-table=three] { --stage: clamp(300px, var(--page, 100vh) - 660px, 40cqw); }
  .frame[data-large] .lab { --t-s: 20px; --t-m: 23px; --t-l: 32px; --touch: 48px; --side: 640px; --bar: 196px;
    --stage: clamp(390px, var(--page, 100vh) - 470px, 62cqw); }
}
@container (max-width: 1180px) { .lab { --side: 360px; --gap: 16px; --bar: 132px; --stage: clamp(390px, var(--page, 100vh) - 346px, 62cqw); } }
@container (max-width: 900px) { .lab { --side: 300px; } }
@container (min-width: 701px) and (max-width: 1499px) {
  .frame[data-large] .lab { --side: clamp(300px, 38cqw, 530px); --bar: 160px; --stage: clamp(440px, var(--page, 100vh) - 396px, 62cqw); }
  .frame[data-large] .lab[data-table=three] { --stage: clamp(300px, var(--page, 100vh) - 540px, 40cqw); }
}
@container (max-width: 700px) {
  .lab, .lab[data-table=three] { --touch: 44px; --stage: 300px; --bar: 132px; display: flex; flex-direction: column; gap: 0; padding: 0; }
  .stage { height: var(--stage); flex: none; border-radius: 0; position: sticky; top: calc(var(--top, 48px) * var(--type, 1)); z-index: 2; }
  .lab[data-table=three] .stage { height: 340px; position: relative; top: 0; }
  .strip, .say, .answer, .keeps { padding: 8px 16px 0; } .link { min-height: var(--touch); }
  .dock { order: 1; z-index: 3; margin-top: 16px; }
  :is(.body, .numbers) { margin: 0 16px; } .body { margin-top: 16px; }
  :is(.body, .numbers) :is(summary, input, button) { scroll-margin: calc(var(--stage) + 60px) 0 190px; } /* between stage and dock */
}
`;

// In a frame of another page: the top, the line and the controls. On a phone the words keep the height of the longest, so that
// the page below does not move as it plays.
const framed = `
.frame[data-framed] :is(.answer, .keeps, .numbers, .body, .outline, .say p:not(.small) .link) { display: none; }
@container (min-width: 701px) { .frame[data-framed] .lab { --gap: 16px; grid-template: "stage controls" var(--stage) "strip controls" var(--bar) "say controls" auto / minmax(0, 1fr) var(--side); } }
@container (max-width: 700px) { .frame[data-framed] .say > div { min-height: calc(1.3 * var(--t-l) + 5.8 * var(--t-m)); } }
`;

// Nothing but its ground until a run has arrived.
const stage = `
.lab:not([data-table]) > :not(.stage), .lab:not([data-table]) .stage > * { visibility: hidden; }
.lab.old .top { opacity: .38; }
@container (max-width: 1180px) { .top { top: 20px; } .lab[data-table=three] .shows { bottom: 72px; } }
@container (max-width: 700px) { .top { top: 44px; } }
.on { position: absolute; left: 12px; right: 12px; top: 12px; display: flex; justify-content: space-between; align-items: flex-start; gap: 8px; pointer-events: none; }
.on > * { pointer-events: auto; }
.switch { background: color-mix(in srgb, var(--ink) 7%, var(--ground)); border-radius: 8px; padding: 3px; }
.switch { display: inline-flex; } .switch > b { align-self: center; padding: 0 8px 0 10px; }
.chip { position: absolute; left: 16px; top: 64px; display: flex; align-items: center; background: var(--ground); border-radius: 16px; padding-left: 12px; font-variant-numeric: tabular-nums; }
.chip button { padding: 0; width: var(--touch); font-size: var(--t-l); border-radius: 16px; } .chip .brief { display: none; }
@container (max-width: 1180px) { .lab > .answer .plot { min-height: 150px; } .chip .whole { display: none; } .chip .brief { display: inline; } .lab > .answer .titled { flex-wrap: wrap; } .lab > .answer h2 { flex-basis: 100%; } }
.law { display: none; } .lab[data-level=research] .law { display: grid; gap: 8px; justify-items: start; padding: 4px 0 8px; } .law .seg { flex-wrap: wrap; }
.touches { display: flex; gap: 8px; align-items: center; min-height: var(--touch); cursor: pointer; } .touches input { width: 18px; height: 18px; margin: 0; accent-color: var(--accent); }
.shows { position: absolute; right: 16px; bottom: 12px; background: var(--ground); border-radius: 8px; max-height: calc(100% - 80px); overflow: auto; }
.shows summary { padding: 4px 12px; cursor: pointer; } .shows .list { display: grid; padding: 0 12px 8px; }
.shows label { display: flex; gap: 8px; align-items: center; min-height: var(--touch); cursor: pointer; } .shows input { width: 18px; height: 18px; margin: 0; accent-color: var(--accent); }
.ring { position: absolute; left: 50%; top: max(58px, 9%); margin-left: -65px; display: flex; align-items: center; gap: 8px; color: var(--q-spin); font-weight: 600; white-space: nowrap;
  font-variant-numeric: tabular-nums; pointer-events: none; }
.ring svg { width: 130px; flex: none; } .ring.back svg { transform: scaleX(-1); }
.ring span { font-size: var(--t-s); text-shadow: 0 0 3px var(--halo), 0 0 4px var(--halo); }
.caption { position: absolute; left: 0; right: 0; bottom: 20px; text-align: center; color: var(--scene-faint); padding: 0 8px; pointer-events: none; }
.caption b, .caption .does { color: var(--scene-ink); }

.unseen { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
.missing { position: absolute; pointer-events: none; left: 16px; right: 16px; bottom: 56px; background: var(--ground); border-radius: 8px; padding: 8px 12px; max-width: 60ch; }
@container (max-width: 700px) {
  .on { left: 8px; right: 8px; top: 8px; gap: 4px; } .switch > b { display: none; } .seg button { padding: 0 9px; min-height: 44px; }
  .ring { top: 66px; left: auto; right: 8px; margin: 0; flex-direction: column; gap: 0; } .ring svg { width: 64px; }
  .lab[data-table=three] .top { top: 60px; bottom: 72px; } .caption { bottom: 4px; height: 68px; font-size: var(--t-s); padding: 0 4px; }
  .lab[data-table=three] .stage { background: var(--scene); }
}
`;

const strip = `
.strip { display: grid; grid-template-columns: 56px minmax(0, 1fr) auto; gap: 6px; align-items: center; }
.starts { display: grid; gap: 4px; justify-items: center; } .clock { font-size: var(--t-s); font-variant-numeric: tabular-nums; }
.paces { display: grid; gap: 4px; justify-items: start; } .again { padding: 0 4px; display: flex; align-items: center; gap: 6px; }
.strip .plot { height: 100%; font-size: var(--t-s); } .strip .now { top: 20px; }
.lab[data-table=three] .strip .ice { stroke-dasharray: 2 3; } .lab.old .strip :is(.rest, .past, .shape) { opacity: .38; }
.then { stroke: var(--line-2); stroke-width: 2; stroke-dasharray: 6 5; fill: none; } .lab.old .then { opacity: .38; }
path.shape { fill: var(--shape); } line.shape { stroke: var(--line-2); }
.say { display: grid; grid-template-columns: 1fr auto; gap: 8px 24px; align-items: start; }
.say > div { min-height: calc(1.3 * var(--t-l) + 2.9 * var(--t-m)); } .say p:not(.big) { max-width: 76ch; }
@container (min-width: 701px) { .say .small .link { min-height: 24px; margin-block: -2px; } } /* in a sentence */
@container (max-width: 1180px) { .outline { max-width: 330px; } }
@container (max-width: 700px) {
  /* on the stage, and as long in sight as that */
  .strip { display: contents; } .strip .plot { height: 124px; margin: 0 16px; padding-top: 8px; flex: none; }
  .starts, .paces { position: sticky; z-index: 3; top: calc(var(--top, 48px) * var(--type, 1) + var(--stage) - 58px); height: 58px; margin-top: -58px; align-self: end; align-content: start; }
  .stage, .starts, .paces { order: -1; } .starts { margin-right: 12px; } .paces { margin-right: 68px; } .clock, .again { display: none; } .speed { background: var(--ground); border-radius: 22px; padding: 0 10px; min-height: 44px; }
  .lab[data-table=three] .strip { display: grid; grid-template: "starts paces" auto "plot plot" auto / auto 1fr; } .lab[data-table=three] .strip .plot { grid-area: plot; margin: 0; }
  .lab[data-table=three] :is(.starts, .paces) { position: static; height: auto; margin: 0; align-self: center; }
  .say { grid-template-columns: 1fr; } .outline { max-width: none; } .outline span { display: inline; font-size: inherit; margin-right: 6px; }
}
`;

const answer = `
.answer { display: flex; flex-direction: column; } .answer > * { flex: none; } .answer .plot { flex: 1; min-height: 200px; margin-top: 4px; } .answer :where(.energy, .own, .turning, .past) { stroke-width: 2; }
svg .washed { stroke: var(--wash); } svg .inside { fill: var(--ground); stroke: var(--lift); }
.answer { --wash: var(--q-energy-wash); --lift: var(--q-energy); }
.lab.old .answer { --wash: color-mix(in srgb, var(--q-energy-wash) 38%, var(--ground)); --lift: color-mix(in srgb, var(--q-energy) 38%, var(--ground)); }
.first { fill: none; stroke: var(--line-2); stroke-dasharray: 4 3; } line.now { stroke: var(--accent); stroke-width: 2; }
svg .word.own { fill: var(--q-spin); } .answer .rest { stroke: var(--line-2); } .answer .past { stroke: var(--ink); }
.readout { position: absolute; background: var(--ground); border: 1px solid var(--line-2); border-radius: 6px; padding: 2px 8px; font-size: var(--t-s); white-space: nowrap; pointer-events: none; font-variant-numeric: tabular-nums; z-index: 1; }
.titled h2 { flex: 1; } .keeps .titled { flex-wrap: wrap; gap: 0 8px; } .keeps h2 { flex: 1 0 auto; } .icon { padding: 0; width: var(--touch); }
.large { border: 0; padding: 24px; width: calc(100vw - 48px); height: calc(100vh - 48px); max-width: none; max-height: none; background: var(--ground); color: var(--ink); border-radius: 8px; }
.large .answer { height: 100%; padding: 0; } .large .icon { font-size: var(--t-l); }
.large::backdrop { background: #0008; }
.dot { fill: var(--ground); stroke: var(--accent); stroke-width: 5; }
.cut { white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
.lab.old .answer :is(polyline, polygon, .rest, .past) { opacity: .38; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }
.half { font-size: var(--t-s); color: var(--ink-2); } th, td { text-align: left; padding: 6px 12px 6px 0; vertical-align: baseline; } th { font-weight: 600; }
thead th { color: var(--ink-2); font-weight: 400; font-size: var(--t-s); } tbody tr { border-top: 1px solid var(--line); }
.kept, .kept + .small { white-space: nowrap; display: inline-block; } .kept { margin-right: 6px; } .kept svg { display: inline-block; vertical-align: -2px; margin-right: 8px; }
@container (max-width: 700px) { .lab > .answer .plot { flex: none; height: 240px; } .large { padding: 16px; width: 100vw; height: 100vh; border-radius: 0; } .large .titled { flex-wrap: wrap; } .mini button { min-height: 44px; min-width: 44px; } }
`;

const controls = `
:is(.controls, .dock) { display: grid; gap: 12px; align-content: start; } .controls .titled { min-height: 44px; }
.ends { position: relative; height: 10px; margin-top: -2px; } .ends.none { margin: -2px 10px 0; background: var(--end-upright); }
.end { position: absolute; top: 0; bottom: 0; } ${endRules}
.end.mixed { background: repeating-linear-gradient(45deg, var(--end-stands) 0 3px, var(--end-leans) 3px 6px); }
.ends .mark { position: absolute; top: -6px; height: 20px; width: 2px; margin-left: -1px; background: var(--accent); }
.ends .was { position: absolute; top: -4px; height: 18px; border-left: 2px dashed var(--ink); margin-left: -1px; }
.launch { min-width: 116px; text-align: right; } .launch .primary { touch-action: none; user-select: none; -webkit-user-select: none; } .wait { display: flex; align-items: center; gap: 12px; } .wait .small { min-width: 4ch; font-variant-numeric: tabular-nums; } .wait .outline { min-height: 40px; }
${progress}:is(.numbers, .body) { border-top: 1px solid var(--line); border-bottom: 1px solid var(--line); } :is(.numbers, .body) summary { min-height: var(--touch); padding: 8px 0; cursor: pointer; list-style: none; display: flex; justify-content: space-between; } :is(.numbers, .body) summary::after { content: "+"; } :is(.numbers, .body)[open] summary::after { content: "−"; }
.body .ctl { margin-bottom: 8px; } .body + :is(.body, .numbers) { border-top: 0; }
.numbers th { font-weight: 400; color: var(--ink-2); } .numbers td { text-align: right; padding-right: 0; } .numbers :is(th, td) { padding-block: 2px; }
.words { position: relative; display: flex; justify-content: space-between; gap: 16px; padding: 2px 10px 0; font-size: var(--t-s); color: var(--ink-2); min-height: 20px; }
.words b { position: absolute; transform: translateX(-50%); color: var(--ink); font-weight: 400; }
@container (max-width: 700px) {
  .controls { display: contents; } .dock { gap: 0; } .controls .titled { align-items: center; } .controls h2 { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
  .chip { top: 60px; left: 8px; white-space: nowrap; } .chip button { flex: none; height: 44px; }
  .pill { max-width: calc(100% - 184px); line-height: 1.2; }
  .shows { left: 16px; right: auto; bottom: 48px; max-height: calc(100% - 170px); } .shows summary { min-height: 44px; padding: 12px; }
  .wait { gap: 6px; } .wait progress { width: 32px; } .wait .small { white-space: nowrap; } .wait .outline { min-height: 44px; padding: 0 10px; }
  .primary { min-height: 44px; }
  ${dock}
  ${forFingers}
}
`;

export const style = [shared, numbers, timed, places, stage, strip, answer, controls, framed].join("");
