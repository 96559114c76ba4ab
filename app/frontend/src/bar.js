// The playback bar: buttons, scrubber, speed, what is shown. It reads and drives a player; it draws nothing itself.
import { colours } from "./colours.js";

const icons = {
  play: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M8 5v14l11-7z"/></svg>',
  pause: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M6 5h4v14H6zm8 0h4v14h-4z"/></svg>',
  back: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M6 6h2v12H6zm3.5 6 8.500 6V6z"/></svg>',
  forward: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M16 6h2v12h-2zM6 18l8.500-6L6 6z"/></svg>',
  view: '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M12 5V2L7.500 6 12 10V7a5 5 0 1 1-5 5H5a7 7 0 1 0 7-7z"/></svg>',
};
const speeds = [1, 2, 4, 8, 16, 32, 64];

// What can be shown or hidden: the parameter's name, what the chip says, its colour, and at length.
export const shows = [
  ["show_track", "track", colours.theta, "The path of the point of contact"],
  ["show_com_path", "<i>G</i>", "#1d2733", "The centre of mass and its path"],
  ["show_force", "<i>F</i>", colours.normal, "The table's force on the top, at the contact"],
  ["show_cone", "cone", colours.friction, "The friction cone: where the force leaves it, the top would slip"],
  ["show_omega", "<i>ω</i>", colours.omega, "The angular velocity"],
  ["show_momentum", "<i>L</i>", colours.momentum, "The angular momentum about G"],
  ["follow", "follow", "#7a8694", "Move the camera along with the top"],
];

export class Bar {
  constructor(root, picture, model, player, resetView) {
    this.player = player;
    const bar = document.createElement("div");
    bar.className = "bar";
    bar.innerHTML = `
      <button class="back" title="One frame back (←)" aria-label="One frame back">${icons.back}</button>
      <button class="play" title="Play or pause (space)"></button>
      <button class="forward" title="One frame forward (→)" aria-label="One frame forward">${icons.forward}</button>
      <input class="scrub" type="range" min="0" max="0" step="1" value="0" aria-label="Time">
      <select class="speed" title="Speed, against the real top's" aria-label="Speed">${speeds
        .map((n) => `<option value="${1 / n}">${n === 1 ? "real speed" : `1/${n} speed`}</option>`)
        .join("")}</select>
      <button class="view" title="Back to the first view" aria-label="Back to the first view">${icons.view}</button>
      <span class="shows">${shows
        .map(([name, text, colour, title]) =>
          `<label title="${title}" style="--swatch: ${colour}"><input type="checkbox" name="${name}" aria-label="${title}"><span class="swatch"></span><span>${text}</span></label>`)
        .join("")}</span>`;
    root.append(bar);
    const find = (selector) => bar.querySelector(selector);
    [this.play, this.scrub, this.speed] = [".play", ".scrub", ".speed"].map(find);
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
      if (event.target.matches("input, select, button")) return;
      const act = { " ": () => this.play.click(), ArrowLeft: () => player.step(-1), ArrowRight: () => player.step(1) }[event.key];
      if (!act) return;
      event.preventDefault();
      act();
    });

    for (const box of bar.querySelectorAll("input[type=checkbox]")) {
      box.onchange = () => (model[box.name] = box.checked);
      const follow = () => (box.checked = model[box.name]);
      model.on(box.name, follow);
      follow();
    }
    const speed = () => {
      // A speed that is not in the list is nobody's choice here, but Python may set it: add it rather than lie.
      if (!speeds.some((n) => 1 / n === model.speed)) this.speed.append(new Option(`${model.speed}× speed`, model.speed));
      this.speed.value = String(model.speed);
    };
    model.on("speed", speed);
    speed();
  }

  // secondsPerUnit: what one (R/g)^1/2 of the real top takes.
  update(secondsPerUnit) {
    const { playing, frames, t } = this.player;
    if (this.shownPlaying !== playing) {
      this.shownPlaying = playing;
      this.play.innerHTML = playing ? icons.pause : icons.play;
      this.play.setAttribute("aria-label", playing ? "Pause" : "Play");
    }
    this.scrub.max = Math.max(frames.count - 1, 0);
    this.scrub.value = this.player.place;
    const seconds = (t * secondsPerUnit).toFixed(4), units = t.toFixed(3);
    this.time.innerHTML = `<b>${seconds} s</b> = ${units} (<i>R</i>/<i>g</i>)<sup>½</sup>`;
    this.scrub.setAttribute("aria-valuetext", `${seconds} seconds`);
  }
}
