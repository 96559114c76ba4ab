// What happens now and why, and where to go next; for three tables, what each of them conserves.
import { latest } from "./curves.js";
import { drawn, part, say } from "./parts.js";
import { TABLES } from "./stage.js";

const LIFTED = ["over", "stands", "inverted"]; // events of a run that friction has turned over
const NEXT = { ordinary: "rough", rough: "research", ice: "three", three: "research" };

export class Words {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {() => void} back goes back to the earlier run */
  constructor(texts, ask, back) {
    this.texts = texts;
    this.headline = part("p", { class: "big" });
    this.why = part("span");
    this.back = part("button", { class: "link", type: "button", hidden: true, onclick: back }, texts.go_back);
    this.next = part("button", { class: "outline", type: "button", onclick: () => {
      const to = NEXT[this.scene.table];
      ask(to === "research" ? "research" : "table", to);
    } });
    this.lesson = part("button", { class: "link", type: "button", hidden: true, onclick: () => ask("why", "") });
    // A screen reader hears it once a stage, not at each frame.
    this.element = part("section", { class: "say" }, part("div", { role: "status" }, this.headline, part("p", {}, this.why, " ", this.back, this.lesson)), this.next);
  }

  show(scene) {
    const { texts } = this;
    this.scene = scene;
    this.next.replaceChildren(part("span", {}, texts.next), part("b", {}, `${texts.nexts[NEXT[scene.table]]} →`));
    const isLifted = scene.table === "three" || (scene.run?.events ?? []).some(([, code]) => LIFTED.includes(code));
    this.lesson.textContent = (isLifted && texts.whys[scene.table]) || "";
    this.said = undefined;
  }

  /** @param {number} t */
  at(t) {
    const { scene, texts } = this, { state } = scene;
    let said = latest(scene.run?.stages ?? [], t)?.slice(1, 3) ?? ["", scene.run?.why ?? ""];
    if (scene.table === "three") said = state.said;
    const { before } = scene;
    if (before?.headline) said = [before.headline, before.why];
    this.back.hidden = !before?.canGoBack || Boolean(state.old);
    if (scene.waits) said = [say(texts, texts.working, { what: state.wants }), say(texts, texts.working_why, { what: state.old })];
    else if (state.old) said = [say(texts, texts.still, { what: state.old }), texts.still_why];
    this.lesson.hidden = !this.lesson.textContent || !this.back.hidden || scene.waits || Boolean(state.old);
    const key = said.join();
    if (key === this.said) return;
    this.said = key;
    [this.headline.textContent, this.why.textContent] = said;
  }
}

const RING = { cx: 7, cy: 7, r: 5.25, fill: "none", stroke: "currentColor", "stroke-width": 1.5 };
const MARKS = {
  full: () => [drawn("circle", { cx: 7, cy: 7, r: 6, fill: "currentColor" })],
  half: () => [drawn("circle", RING), drawn("path", { d: "M7 1a6 6 0 0 1 0 12z", fill: "currentColor" })],
  empty: () => [drawn("circle", RING)],
};

export class Keeps {
  /** @param {Record<string, any>} texts */
  constructor(texts) {
    this.texts = texts;
    this.body = part("tbody");
    this.until = part("span", { class: "small" });
    this.element = part("section", { class: "keeps", tabindex: 0, "aria-label": texts.keeps }, // scrolls on a phone
      part("div", { class: "titled" }, part("h2", {}, texts.keeps), this.until),
      part("table", {}, part("thead", {}, part("tr", {}, part("td"), ...texts.kept.map((word) => part("th", { scope: "col" }, word)))), this.body));
  }

  show(scene) {
    const { texts } = this;
    this.until.textContent = say(texts, texts.span, { t: [scene.end, 0] });
    this.body.replaceChildren(...TABLES.map((table) => {
      const run = scene.runs[table];
      const cells = run?.keeps?.length ? run.keeps.map(([mark, word, numbers]) => part("td", {},
        part("span", { class: "kept" }, drawn("svg", { viewBox: "0 0 14 14", width: 14, height: 14, "aria-hidden": "true" }, ...MARKS[mark]()), word),
        part("span", { class: "small" }, numbers))) : [part("td", { colspan: texts.kept.length }, run?.why ?? "")];
      return part("tr", {}, part("th", { scope: "row" }, texts.tables[table]), ...cells);
    }));
  }
}
