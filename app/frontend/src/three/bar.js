// The playback bar of a top that has no time line: buttons, the frames, the speed, and what is shown.
import { colours } from "../colours.js";
import { fill, local } from "../data.js";
import { follow } from "../life.js";
import { icon, part } from "../parts.js";
/** @import { Player } from "../motion/player.js" */

const SPEEDS = [1, 2, 4, 8, 16, 32, 64];
// What can be shown or hidden: the name of the parameter, and the colour of its button.
const SHOWS = {
  show_track: colours.theta, show_trace: colours.theta, show_com_path: "var(--scene-ink)", show_force: colours.normal, show_cone: colours.friction,
  show_omega: colours.omega, show_momentum: colours.momentum, follow: colours.grey,
};

export class Bar {
  /** @param {HTMLElement} root @param {HTMLElement} picture @param {TopModel} model @param {Player} player @param {(() => void) | null} look back to the first view; null: a flat picture, which shows nothing else */
  constructor(root, picture, model, player, look) {
    const { texts } = model, button = (name, drawing, run) =>
      part("button", { type: "button", class: name, title: texts[`${name}_hint`] ?? texts[name], "aria-label": texts[name], onclick: run }, icon(drawing));
    this.player = player;
    this.texts = texts;
    this.play = button("play", "play", () => player.setPlaying(!player.playing));
    this.scrub = part("input", { class: "scrub", type: "range", min: 0, max: 0, step: 1, value: 0, "aria-label": texts.time, oninput: () => player.show(Number(this.scrub.value)) });
    const speed = part("select", { title: texts.speed_hint, "aria-label": texts.speed, onchange: () => (model.speed = Number(speed.value)) },
      ...SPEEDS.map((n) => part("option", { value: 1 / n }, n === 1 ? texts.real_speed : fill(texts.slower, { times: n }))));
    const bar = part("div", { class: "bar" }, button("back", "back", () => player.step(-1)), this.play, button("forward", "forward", () => player.step(1)), this.scrub, speed);
    if (look) bar.append(button("view", "again", look), part("span", { class: "shows" }, ...Object.keys(SHOWS).map((name) => this.shows(model, name))));
    this.time = part("div", { class: "time" });
    root.append(bar);
    picture.append(this.time);
    follow(model, ["speed"], () => {
      // Python may set a speed that is not in the list: add it, so that the bar shows the true one.
      if (!SPEEDS.some((n) => 1 / n === model.speed)) speed.append(new Option(fill(texts.faster, { times: model.speed }), String(model.speed)));
      speed.value = String(model.speed);
    });
  }

  shows(model, name) {
    const [text, title] = model.texts.shows[name], box = part("input", { type: "checkbox", name, "aria-label": title, onchange: () => (model[name] = box.checked) }), words = part("span");
    words.innerHTML = text;
    follow(model, [name], () => (box.checked = model[name]));
    return part("label", { title, style: `--swatch: ${SHOWS[name]}` }, box, part("span", { class: "swatch" }), words);
  }

  /** @param {number} secondsPerUnit s in one (R/g)^1/2 of the real top */
  update(secondsPerUnit) {
    const { playing, frames, t, place } = this.player, name = playing ? "pause" : "play";
    if (this.shown !== name) {
      this.shown = name;
      this.play.replaceChildren(icon(name));
      this.play.setAttribute("aria-label", this.texts[name]);
    }
    this.scrub.max = String(Math.max(frames.count - 1, 0));
    this.scrub.value = String(place);
    const seconds = local((t * secondsPerUnit).toFixed(4)), units = local(t.toFixed(3));
    this.time.innerHTML = `<b>${seconds} s</b> = ${units} (<i>R</i>/<i>g</i>)<sup>½</sup>`;
    this.scrub.setAttribute("aria-valuetext", fill(this.texts.seconds, { seconds }));
  }
}
