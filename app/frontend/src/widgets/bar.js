// The playback bar: buttons, slider of the time, speed, and what is shown. It controls a player, and draws nothing
// itself.
import { colours } from "../colours.js";
import { fill, local } from "../data.js";
/** @import { Player } from "../motion/player.js" */

const icons = {
  play: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M8 5v14l11-7z"/></svg>',
  pause: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M6 5h4v14H6zm8 0h4v14h-4z"/></svg>',
  back: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M6 6h2v12H6zm3.5 6 8.500 6V6z"/></svg>',
  forward: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M16 6h2v12h-2zM6 18l8.500-6L6 6z"/></svg>',
  view: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M12 5V2L7.500 6 12 10V7a5 5 0 1 1-5 5H5a7 7 0 1 0 7-7z"/></svg>',
};
const speeds = [1, 2, 4, 8, 16, 32, 64];

// What can be shown or hidden: the name of the parameter, and the colour of its button.
const shows = {
  show_track: colours.theta, show_trace: colours.theta, show_com_path: "var(--scene-ink, #1d2733)", show_force: colours.normal, show_cone: colours.friction,
  show_omega: colours.omega, show_momentum: colours.momentum, follow: "#7a8694",
};

export class Bar {
  /** @param {HTMLElement} root @param {HTMLElement} picture @param {TopModel} model @param {Player} player @param {() => void} resetView */
  constructor(root, picture, model, player, resetView) {
    this.player = player;
    const texts = (this.texts = model.texts);
    const bar = document.createElement("div");
    bar.className = "bar";
    bar.innerHTML = `
      <button class="back" title="${texts.back_hint}" aria-label="${texts.back}">${icons.back}</button>
      <button class="play" title="${texts.play_hint}"></button>
      <button class="forward" title="${texts.forward_hint}" aria-label="${texts.forward}">${icons.forward}</button>
      <input class="scrub" type="range" min="0" max="0" step="1" value="0" aria-label="${texts.time}">
      <select class="speed" title="${texts.speed_hint}" aria-label="${texts.speed}">${speeds
        .map((n) => `<option value="${1 / n}">${n === 1 ? texts.real_speed : fill(texts.slower, { times: n })}</option>`)
        .join("")}</select>
      <button class="view" title="${texts.view}" aria-label="${texts.view}">${icons.view}</button>
      <span class="shows">${Object.entries(shows)
        .map(([name, colour]) => [name, colour, ...texts.shows[name]])
        .map(([name, colour, text, title]) =>
          `<label title="${title}" style="--swatch: ${colour}"><input type="checkbox" name="${name}" aria-label="${title}"><span class="swatch"></span><span>${text}</span></label>`)
        .join("")}</span>`;
    root.append(bar);
    /** @returns {any} */
    const find = (selector) => bar.querySelector(selector);
    /** @type {HTMLButtonElement} */
    this.play = find(".play");
    /** @type {HTMLInputElement} */
    this.scrub = find(".scrub");
    /** @type {HTMLSelectElement} */
    this.speed = find(".speed");
    this.time = document.createElement("div");
    this.time.className = "time";
    picture.append(this.time);

    find(".back").onclick = () => player.step(-1);
    find(".forward").onclick = () => player.step(1);
    this.play.onclick = () => player.setPlaying(!player.playing);
    find(".view").onclick = resetView;
    this.scrub.oninput = () => player.show(Number(this.scrub.value));
    this.speed.onchange = () => (model.speed = Number(this.speed.value));
    root.addEventListener("keydown", (event) => {
      if (/** @type {Element} */ (event.target).matches("input, select, button")) return;
      const act = { " ": () => this.play.click(), ArrowLeft: () => player.step(-1), ArrowRight: () => player.step(1) }[event.key];
      if (!act) return;
      event.preventDefault();
      act();
    });

    for (const box of /** @type {NodeListOf<HTMLInputElement>} */ (bar.querySelectorAll("input[type=checkbox]"))) {
      box.onchange = () => (model[box.name] = box.checked);
      const follow = () => (box.checked = model[box.name]);
      model.on(box.name, follow);
      follow();
    }
    const speed = () => {
      // Python may set a speed that is not in the list: add it, so that the bar shows the true one.
      if (!speeds.some((n) => 1 / n === model.speed)) this.speed.append(new Option(fill(texts.faster, { times: model.speed }), String(model.speed)));
      this.speed.value = String(model.speed);
    };
    model.on("speed", speed);
    speed();
  }

  /** @param {number} secondsPerUnit s in one (R/g)^1/2 of the real top */
  update(secondsPerUnit) {
    const { playing, frames, t } = this.player;
    if (this.shownPlaying !== playing) {
      this.shownPlaying = playing;
      this.play.innerHTML = playing ? icons.pause : icons.play;
      this.play.setAttribute("aria-label", playing ? this.texts.pause : this.texts.play);
    }
    this.scrub.max = String(Math.max(frames.count - 1, 0));
    this.scrub.value = String(this.player.place);
    const seconds = local((t * secondsPerUnit).toFixed(4)), units = local(t.toFixed(3));
    this.time.innerHTML = `<b>${seconds} s</b> = ${units} (<i>R</i>/<i>g</i>)<sup>½</sup>`;
    this.scrub.setAttribute("aria-valuetext", fill(this.texts.seconds, { seconds }));
  }
}
