// What happens now and why, above it what was changed, and where to go next.
import { latest } from "../motion/curves.js";
import { part, say } from "../parts.js";

const NEXT = { ordinary: "rough", rough: "research", ice: "three", three: "research" };
const OPEN = { rough: "three" }; // where the research is open already, or not there

/** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {() => void} goBack to the earlier run */
export function wordsOf(texts, ask, goBack) {
  const headline = part("p", { class: "big" }), why = part("span"), compared = part("span");
  const back = part("button", { class: "link", type: "button", hidden: true, onclick: goBack }, texts.go_back);
  const next = part("button", { class: "outline", type: "button", onclick: () => ask(to === "research" ? to : "table", to) });
  const lesson = part("button", { class: "link", type: "button", hidden: true, onclick: () => ask(scene.state.caught ? "why_not" : "why", "") });
  const above = part("p", { class: "small" }, compared, " ", back);
  let scene = /** @type {any} */ (null), to = "", written = "";
  return {
    // A screen reader hears it once a stage, not at each frame.
    element: part("section", { class: "say" }, part("div", { role: "status" }, above, headline, part("p", {}, why, " ", lesson)), next),
    show(/** @type {any} */ now) {
      scene = now;
      const { table, state, isOpen, run, before } = scene, wanted = NEXT[table];
      to = wanted === "research" && (isOpen || !texts.nexts[wanted]) ? OPEN[table] : wanted;
      next.hidden = !to;
      if (to) next.replaceChildren(part("span", {}, texts.next), part("b", {}, `${texts.nexts[to]}\u00a0→`));
      const isLifted = table === "three" || (run?.events ?? []).some(([, code]) => code === "over");
      lesson.textContent = state.caught ? texts.more.caught : (isLifted && texts.whys[table]) || "";
      written = "";
      compared.textContent = before?.compared ?? "";
    },
    at(/** @type {number} */ t) {
      const { state, run, before, table, waits } = scene;
      let wording = latest(run?.stages ?? [], t)?.slice(1, 3) ?? ["", run?.why ?? ""];
      if (table === "three") wording = state.wording;
      if (waits) wording = [say(texts, texts.working, { what: state.wants }), say(texts, texts.working_why, { what: state.old })];
      else if (state.old) wording = [say(texts, texts.still, { what: state.old }), texts.still_why];
      above.hidden = !before?.compared || Boolean(state.old);
      back.hidden = !before?.canGoBack;
      lesson.hidden = !lesson.textContent || waits || Boolean(state.old);
      if (wording.join() === written) return;
      written = wording.join();
      [headline.textContent, why.textContent] = wording;
    },
  };
}
