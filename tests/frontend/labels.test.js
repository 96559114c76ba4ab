import assert from "node:assert/strict";
import { test } from "node:test";
import { Group, PerspectiveCamera, Vector3 } from "three";
import { Handle } from "../../app/frontend/src/three/handle.js";
import { Labels } from "../../app/frontend/src/three/labels.js";
import { element, near } from "./helping.js";

// A camera on the x axis that looks at O, with z up: a vertical angle of 90 degrees, a picture twice as wide as high.
function stageOf() {
  const camera = new PerspectiveCamera(90, 2, 0.1, 100);
  camera.up.set(0, 0, 1);
  camera.position.set(10, 0, 0);
  camera.lookAt(0, 0, 0);
  return { camera, width: 400, height: 200, holder: { ...element(), getBoundingClientRect: () => ({ left: 30, top: 7 }) } };
}
const placeOf = ({ element: { style } }) => style.transform.match(/-?[\d.]+(?=px)/g).map(Number);

test("a text is placed where its point appears", () => {
  const stage = stageOf(), labels = new Labels(stage), label = labels.add("G");
  // At a distance of 10 the picture is 20 high and 40 wide; y points to the right, z up.
  for (const [at, seen] of [[[0, 0, 0], [200, 100]], [[0, 20, 0], [400, 100]], [[0, 0, 10], [200, 0]], [[5, -5, -2.5], [100, 150]]]) {
    label.at.set(...at);
    labels.place();
    near(placeOf(label), seen, 0.06);
  }
  label.shift = [12, -7];
  labels.place();
  near(placeOf(label), [112, 143], 0.06);
  label.margin = 40; // of one that stays within the picture
  for (const [at, seen] of [[[0, 60, 0], [360, 93]], [[0, 0, -90], [212, 160]]]) {
    label.at.set(...at);
    labels.place();
    near(placeOf(label), seen, 0.06);
  }
});

test("a text behind the camera, or an invisible one, is hidden", () => {
  const stage = stageOf(), labels = new Labels(stage), label = labels.add("G");
  const shown = () => (labels.place(), label.element.style.display !== "none");
  assert.equal(shown(), true);
  label.at.set(20, 0, 0);
  assert.equal(shown(), false);
  label.at.set(0, 0, 0);
  label.visible = false;
  assert.equal(shown(), false);
});

test("the handle requests the tilt under the pointer, in every direction, also beyond the vertical", () => {
  const stage = stageOf(), labels = new Labels(stage), body = new Group(), round = [], pulled = { letGo() {}, to: (...asked) => (pulled.last = asked) };
  const handle = new Handle(stage, labels, {}, pulled);
  body.top = 1.7;
  body.position.set(0.3, 0.2, 1);
  const lean = (tilt, towards) => {
    body.quaternion.setFromAxisAngle(new Vector3(-Math.sin(towards), Math.cos(towards), 0), tilt); // of z towards there
    handle.follow(body, tilt, true);
    near([handle.theta, handle.axis.x, handle.axis.z], [tilt, Math.sin(tilt) * Math.cos(towards), Math.cos(tilt)]);
    labels.place();
    return placeOf(handle.label);
  };
  for (const [tilt, towards] of [[0.7, 1.2], [2.5, 1.9], [0.05, -1.5]]) {
    const [x, y] = lean(tilt, towards);
    assert.ok(handle.label.at.distanceTo(body.position) > body.top);
    lean(tilt + 0.2, towards + 0.2);
    handle.take();
    handle.pull({ clientX: x + 30, clientY: y + 7 });
    near(pulled.last[0], tilt, 0.02);
  }
  body.position.set(0, 0, 0);
  lean(0.1, Math.PI / 2); // towards y, across the picture
  handle.take();
  for (const turn of [0.1, 0, -0.5, -1, -1.5, -1, 0, 0.2, 1]) {
    const [y, z] = [handle.reach * Math.sin(turn), handle.reach * Math.cos(turn)];
    handle.pull({ clientX: 30 + 200 + 10 * y, clientY: 7 + 100 - 10 * z });
    round.push(pulled.last[0] * Math.sign(Math.sin(pulled.last[1])));
  }
  near(round, [0.1, 0, -0.5, -1, -1.5, -1, 0, 0.2, 1], 0.002);
  body.quaternion.identity(); // upright it leans where it leaned
  handle.follow(body, 0, true);
  handle.take();
  near(handle.lean, [0, 1]);
  assert.equal(handle.begins(), false);
  handle.requested = true; // by a key: for the one motion that answers it
  assert.deepEqual([handle.begins(), handle.begins()], [true, false]);
  handle.held = true;
  assert.deepEqual([handle.begins(), handle.begins()], [true, true]);
});
