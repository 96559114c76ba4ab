// The top without WebGL: seen from the side, so that its tilt is to scale, drawn in the plane; the same bar plays it.
import { Bar } from "./bar.js";
import { colours } from "./colours.js";
import { coalesce, float32 } from "./data.js";
import { emptyPose } from "./frames.js";
import { Player } from "./player.js";
import { followLook } from "./scene.js";

const LEAST_REACH = 1.6, BELOW = 0.6; // from O upwards, and below the table, in R

export function renderFlat({ model, root, picture, view }) {
  const canvas = document.createElement("canvas");
  canvas.style.cursor = "default";
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", model.label || model.texts.label);
  picture.prepend(canvas);
  const words = picture.querySelector(".note");
  words.textContent = model.texts.flat;
  Object.assign(words.style, { position: "static", marginTop: "6px" });
  const pen = canvas.getContext("2d");
  const pose = emptyPose();
  const suffix = model.clock ? `:${model.clock}` : "";
  let pictures = 0, reach = LEAST_REACH, look;
  const hex = (colour) => `#${colour.toString(16).padStart(6, "0")}`;

  const player = new Player({
    changed: () => draw(),
    landed: () => (model.time = player.t),
    playingChanged: () => (model.playing = player.playing),
  });
  const bar = new Bar(root, picture, model, player, () => {});
  for (const part of root.querySelectorAll(".shows, .view")) part.remove(); // there is nothing of that to see
  root.append(words);

  const draw = coalesce(() => {
    const now = performance.now();
    if (player.playing) player.advance(now, model.speed / (1000 * model.seconds));
    const { clientWidth: width, clientHeight: height } = picture;
    if (!width || !height) return;
    canvas.width = width * devicePixelRatio;
    canvas.height = height * devicePixelRatio;
    pen.scale(devicePixelRatio, devicePixelRatio);
    const R = height / (reach + 1.3 + BELOW), table = height - BELOW * R;
    pen.fillStyle = hex(look.table);
    pen.fillRect(0, table, width, height - table);
    if (player.frames.count) {
      player.frames.read(player.place, pose);
      const { x, y, z, w } = pose.quaternion;
      const tilt = Math.acos(Math.min(1, Math.max(-1, 1 - 2 * (x * x + y * y))));
      top(width / 2, table - R, R, tilt, Math.atan2(z, w) - Math.atan2(y, x)); // psi
      bar.update(model.seconds);
      window.dispatchEvent(new CustomEvent(`tippe:clock${suffix}`, {
        detail: { t: player.t, index: player.index, playing: player.playing },
      }));
    }
    pictures += 1;
    if (player.playing) draw();
  });

  // The outline, turned about O, with a mark that goes round with the body.
  function top(x, y, R, tilt, turn) {
    const profile = float32(model.profile), n = profile.length >> 1;
    pen.save();
    pen.translate(x, y);
    pen.rotate(tilt);
    pen.beginPath();
    for (let i = 0; i < n; i++) pen.lineTo(R * profile[2 * i], -R * profile[2 * i + 1]);
    for (let i = n - 1; i >= 0; i--) pen.lineTo(-R * profile[2 * i], -R * profile[2 * i + 1]);
    pen.closePath();
    pen.fillStyle = "#e3b981";
    pen.strokeStyle = hex(look.edge);
    pen.lineWidth = 2;
    pen.fill();
    pen.stroke();
    pen.setLineDash([8, 5]);
    pen.beginPath();
    pen.moveTo(0, 1.2 * R);
    pen.lineTo(0, -1.8 * R);
    pen.stroke();
    pen.setLineDash([]);
    if (Math.cos(turn) > 0) {
      pen.fillStyle = colours.theta;
      pen.beginPath();
      pen.ellipse(0.8 * R * Math.sin(turn), 0.4 * R, 0.1 * R * Math.cos(turn), 0.1 * R, 0, 0, 2 * Math.PI);
      pen.fill();
    }
    pen.restore();
    pen.fillStyle = hex(look.ink);
    pen.font = "600 15px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.fillText(`θ = ${((180 * tilt) / Math.PI).toFixed(1)}°`, x, 24);
  }

  const onFrames = () => player.setFrames(model.frames);
  model.on("frames", onFrames);
  const onProfile = () => {
    const profile = float32(model.profile);
    reach = LEAST_REACH;
    for (let i = 0; i + 1 < profile.length; i += 2) reach = Math.max(reach, Math.hypot(profile[i], profile[i + 1]));
    draw();
  };
  model.on("profile", onProfile);
  model.on("playing", () => player.setPlaying(model.playing));
  const onSeek = ({ detail: { t, held } }) => player.seek(t, held);
  window.addEventListener(`tippe:seek${suffix}`, onSeek);
  const resizing = new ResizeObserver(draw);
  resizing.observe(picture);
  onProfile();
  onFrames();
  player.setPlaying(model.playing);

  (window.__tippe ??= {}).flat = { get pictures() { return pictures; }, get t() { return player.t; } };
  const unfollow = followLook((now) => {
    look = now;
    draw();
  });
  const dispose = () => {
    unfollow();
    draw.cancel();
    resizing.disconnect();
    window.removeEventListener(`tippe:seek${suffix}`, onSeek);
  };
  view.tippe = { dispose };
  model.on("remove", dispose);
}
