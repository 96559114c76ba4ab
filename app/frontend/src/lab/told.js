// The stage in words, for those who do not see it: how far each top leans, what carries it, and how it turns.
import { latest, SPIN, TABLES, TILT, TURNING } from "../motion/curves.js";
import { part, say } from "../parts.js";
import { debounce } from "../data.js";

const SAY_MS = 400; // said once nothing new has happened for this long
const STILL = 0.05; // turns a second that are not worth a word

// A top at a time.
/** @param {Record<string, any>} texts @param {{ curves: import("../motion/curves.js").Curves, run: any }} of @param {number} t in s */
export function inWords(texts, { curves, run }, t) {
  const { leans, turns, rate, still, ways } = texts.told, [, on] = latest(run.carried, t);
  const [above, own] = [TURNING, SPIN].map((column) => {
    const turning = curves.at(t, column), most = Math.abs(turning);
    return most < STILL ? still : say(texts, rate, { turns: [most, most < 9.95 ? 1 : 0], way: ways[Number(turning < 0)] });
  });
  return `${say(texts, leans, { tilt: [curves.at(t, TILT), 0], on })} ${say(texts, turns, { above, own })}`;
}

/** @param {Record<string, any>} texts @param {import("./time.js").Time} time @param {AbortSignal} life @param {(words: Record<number, string>) => void} describe the pictures that show a run: 0 of one top alone, 1 to 3 of three */
export function toldOf(texts, time, life, describe) {
  const element = part("p", { class: "unseen", role: "status", "aria-label": texts.told.label });
  let tops = /** @type {any[]} */ ([]), heard = "", old = ""; // those that are shown; when it was said, or what was happening
  const speak = debounce(() => {
    const said = tops.map((top) => inWords(texts, top, time.t));
    element.textContent = said.map((words, i) => tops[i].name + words).join(" ");
    describe(Object.fromEntries(tops.map(({ place, run }, i) => [place, [old, latest(run.stages, time.t)?.[1], said[i]].filter(Boolean).join(" ")])));
  }, SAY_MS, life);
  return {
    element,
    show({ table, curves, runs, state }) {
      old = state.old ? `${say(texts, texts.old, { what: state.old })}.` : "";
      tops = (table === "three" ? TABLES : [table]).flatMap((name, i) => (
        curves[name].count && runs[name] ? [{ place: table === "three" ? i + 1 : 0, curves: curves[name], run: runs[name], name: table === "three" ? `${texts.tables[name]}: ` : "" }] : []));
      heard = "";
    },
    // While it plays, it is said when the story comes to another part or something else carries the top; otherwise always.
    at(/** @type {number} */ t) {
      const now = tops.map(({ run }) => [latest(run.stages, t)?.[0], latest(run.carried, t)[0]]), news = time.playing ? JSON.stringify(now) : String(t);
      if (news === heard || time.held) return;
      heard = news;
      speak();
    },
  };
}
