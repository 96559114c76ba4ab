// The top without WebGL: seen from the side, so that its tilt is to scale, drawn in the plane; the same bar plays it.
import { Bar } from "../widgets/bar.js";
import { Place } from "../motion/clock.js";
import { colours } from "../colours.js";
import { coalesce, float32, penOf } from "../data.js";
import { emptyPose } from "../motion/frames.js";
import { wordOf } from "../regimes.js";
import { followLook } from "../three/scene.js";

const LEAST_REACH = 1.6, BELOW = 0.6; // from O upwards, and below the table, in R
const WIDTH = 640; // px, of a picture for print whose place on the page has no size

/** @param {Omit<Rendering<TopModel>, "el"> & { root: HTMLElement, picture: HTMLElement }} rendering */
export function renderFlat({ model, root, picture, view }) {
  const canvas = document.createElement("canvas");
  canvas.style.cursor = "default";
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", model.label || model.texts.label);
  picture.prepend(canvas);
  const words = /** @type {HTMLElement} */ (picture.querySelector(".note"));
  words.textContent = model.texts.flat;
  Object.assign(words.style, { position: "static", marginTop: "6px" });
  let pen;
  const pose = emptyPose();
  let pictures = 0, reach = LEAST_REACH, look, verdict = model.texts.no_motion;
  const hex = (colour) => `#${colour.toString(16).padStart(6, "0")}`;

  const report = {
    get pictures() { return pictures; },
    get t() { return player.t; },
    get index() { return player.index; },
    get count() { return player.frames.count; },
    get playing() { return player.playing; },
    get verdict() { return verdict; },
  };
  const place = new Place({
    model, picture, report,
    changed: () => draw(),
    inView: () => picture.clientWidth > 0,
    photo: (wide) => {
      const still = document.createElement("canvas"), { clientWidth: width, clientHeight: height } = picture;
      const scale = wide / (width || WIDTH);
      still.width = wide;
      still.height = Math.round(scale * (height || WIDTH));
      paint(still, still.width / scale, still.height / scale, scale);
      return still;
    },
  });
  const { player } = place;
  const bar = new Bar(root, picture, model, player, () => {});
  for (const part of root.querySelectorAll(".shows, .view")) part.remove(); // there is nothing of that to see
  root.append(words);

  const draw = coalesce(() => {
    if (place.moves) place.advance(performance.now());
    const { clientWidth: width, clientHeight: height } = picture;
    if (width && height) {
      canvas.width = width * devicePixelRatio;
      canvas.height = height * devicePixelRatio;
      paint(canvas, width, height, devicePixelRatio);
      pictures += 1;
    }
    if (player.frames.count) bar.update(model.seconds);
    place.say(verdict);
    if (place.moves) draw();
  });

  function paint(on, width, height, scale) {
    pen = penOf(on);
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.fillStyle = hex(look.sky);
    pen.fillRect(0, 0, width, height);
    const R = height / (reach + 1.3 + BELOW), table = height - BELOW * R;
    pen.fillStyle = hex(look.table);
    pen.fillRect(0, table, width, height - table);
    verdict = model.texts.no_motion;
    if (!player.frames.count) return;
    player.frames.read(player.place, pose);
    const { x, y, z, w } = pose.quaternion;
    const tilt = Math.acos(Math.min(1, Math.max(-1, 1 - 2 * (x * x + y * y))));
    // off the table, or on its stem, the sphere's centre is where G and the axis say
    const up = model.a === null ? 1 : pose.com.z + model.a * Math.cos(tilt);
    top(width / 2, table - up * R, R, tilt, Math.atan2(z, w) - Math.atan2(y, x)); // psi
    verdict = wordOf(pose.regime, model.texts.verdicts);
  }

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

  model.on("frames", () => {
    place.take();
    draw();
  });
  const onProfile = () => {
    const profile = float32(model.profile);
    reach = LEAST_REACH;
    for (let i = 0; i + 1 < profile.length; i += 2) reach = Math.max(reach, Math.hypot(profile[i], profile[i + 1]));
    draw();
  };
  model.on("profile", onProfile);
  const resizing = new ResizeObserver(draw);
  resizing.observe(picture);
  onProfile();
  place.take();
  place.begin();
  if (!model.clock) window.__tippe.flat = report;

  const unfollow = followLook((now) => {
    look = now;
    draw();
  });
  const dispose = () => {
    unfollow();
    draw.cancel();
    resizing.disconnect();
    place.leave();
    if (window.__tippe.flat === report) delete window.__tippe.flat;
  };
  view.tippe = { dispose };
  model.on("remove", dispose);
}
