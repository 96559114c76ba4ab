// What happens now and why, above it what was changed, and where to go next.
import { latest } from "./curves.js";
import { part, say } from "./parts.js";

const NEXT = { ordinary: "rough", rough: "research", ice: "three", three: "research" };
const OPEN = { rough: "three" }; // where the research is open already, or not there

export class Words {
  /** @param {Record<string, any>} texts @param {(name: string, value: any) => void} ask @param {() => void} back goes back to the earlier run */
  constructor(texts, ask, back) {
    this.texts = texts;
    this.headline = part("p", { class: "big" });
    this.why = part("span");
    this.compared = part("span");
    this.back = part("button", { class: "link", type: "button", hidden: true, onclick: back }, texts.go_back);
    this.next = part("button", { class: "outline", type: "button", onclick: () => {
      const to = this.to;
      ask(to === "research" ? "research" : "table", to);
    } });
    this.lesson = part("button", { class: "link", type: "button", hidden: true, onclick: () => ask(this.scene.state.caught ? "why_not" : "why", "") });
    // A screen reader hears it once a stage, not at each frame.
    this.element = part("section", { class: "say" }, part("div", { role: "status" }, part("p", { class: "small" }, this.compared, " ", this.back),
      this.headline, part("p", {}, this.why, " ", this.lesson)), this.next);
  }

  show(scene) {
    const { texts } = this;
    this.scene = scene;
    const next = NEXT[scene.table];
    this.to = next === "research" && (scene.isOpen || !texts.nexts[next]) ? OPEN[scene.table] : next;
    this.next.hidden = !this.to;
    if (this.to) this.next.replaceChildren(part("span", {}, texts.next), part("b", {}, `${texts.nexts[this.to]} →`));
    const isLifted = scene.table === "three" || (scene.run?.events ?? []).some(([, code]) => code === "over");
    this.lesson.textContent = scene.state.caught ? texts.more.caught : (isLifted && texts.whys[scene.table]) || "";
    this.said = undefined;
    this.compared.textContent = scene.before?.compared ?? "";
  }

  /** @param {number} t */
  at(t) {
    const { scene, texts } = this, { state } = scene;
    let said = latest(scene.run?.stages ?? [], t)?.slice(1, 3) ?? ["", scene.run?.why ?? ""];
    if (scene.table === "three") said = state.said;
    const { before } = scene;
    this.compared.parentElement.hidden = !before?.compared || Boolean(state.old);
    this.back.hidden = !before?.canGoBack;
    if (scene.waits) said = [say(texts, texts.working, { what: state.wants }), say(texts, texts.working_why, { what: state.old })];
    else if (state.old) said = [say(texts, texts.still, { what: state.old }), texts.still_why];
    this.lesson.hidden = !this.lesson.textContent || scene.waits || Boolean(state.old);
    const key = said.join();
    if (key === this.said) return;
    this.said = key;
    [this.headline.textContent, this.why.textContent] = said;
  }
}
