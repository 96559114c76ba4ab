// What happened in a run, and when. Clicking an event goes there; the last one that has happened is marked.
import { followClock, seek } from "../figures/seeking.js";
import { frame } from "../controls/frame.js";
import { follow } from "../life.js";
import { latest } from "../motion/curves.js";
import { part } from "../parts.js";

const style = `
ol { list-style: none; margin: 0; padding: 0; font-size: calc(14px * var(--type, 1)); line-height: 1.35; }
button { display: grid; grid-template-columns: 4em 1fr 1.4fr; gap: 0 10px; width: 100%; min-height: 24px; padding: 3px 8px; text-align: left; font-variant-numeric: tabular-nums; }
span { color: var(--faint); } i { font-family: Georgia, serif; } sub { font-size: 0.75em; line-height: 0; }
button[aria-current] { box-shadow: inset 3px 0 0 currentColor; }
@media (max-width: 700px) { button { grid-template-columns: 4.2em 1fr; } span:last-child { grid-column: 2; } }
`;

/** @param {Rendering<EventListModel>} rendering */
export function renderEventList(rendering) {
  const { model } = rendering, list = part("ol"), life = frame(rendering, style, list);
  const mark = (t) => {
    const now = latest(model.rows, t);
    for (const [i, { firstChild }] of [...list.children].entries()) firstChild.ariaCurrent = model.rows[i] === now ? "true" : null;
  };
  follow(model, ["rows"], () => {
    list.replaceChildren(...model.rows.map(([t, when, word, more]) => {
      const after = part("span");
      after.innerHTML = more;
      return part("li", {}, part("button", { type: "button", onclick: () => seek(t, false, model.clock) },
        part("span", {}, when), part("b", {}, word), after));
    }));
    if (model.rows.length) mark(0);
  });
  followClock(({ t }) => model.rows.length && mark(t), model.clock, life);
}
