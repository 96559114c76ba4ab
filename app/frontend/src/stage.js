// A canvas with a camera that a person can turn: builds, resizes, draws when asked, and lets go of everything.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

// Where WebGL is drawn by the processor, moving pictures leave time for the rest of the page, and get coarser until they
// do; a picture at rest is always drawn fine.
const SLOW_MS = 24; // a picture that takes longer than this to come out
const REST = 1.6; // is followed by the next one after this many times as long
const COARSER_MS = 34;
const FINER_MS = 20;
const STEP = 0.8;
const COARSEST = 0.6;
const MOST_TRIES = 4; // to go back to finer ones, then it stays as it is
const MAX_PIXEL_RATIO = 2;

// There, what a person moves on the page comes first: while a hand is on a control, pictures in 3-D are drawn only of what
// is new, one a frame of the screen, and without what takes long: fine pixels, a new shadow, long wide lines.
const HELD_MS = 180; // from one picture of a stage to its next
const HAND_MS = 300; // how long after its last input a hand is taken to have let go
const HAND_COARSE = 0.5;
const LONG_LINE = 300; // segments
let slow = false; // whether the processor draws, as any stage measured
let anyDrawnAt = 0;
let inputAt = -Infinity;
const isCanvas = (target) => target.localName === "canvas";
const onInput = (event) => {
  const used = event.type === "keydown" || event.buttons > 0;
  if (used && !event.composedPath().some(isCanvas)) inputAt = performance.now(); // a canvas: turning the picture itself
};
for (const type of ["pointerdown", "pointermove", "keydown"]) window.addEventListener(type, onInput, { capture: true });

export class Stage {
  // tick(now) runs before each drawn frame and says whether another one is to follow; fit(aspect) runs after a new size.
  constructor(holder, { label, fov, tick = () => false, fit = () => {} }) {
    this.holder = holder;
    this.tick = tick;
    this.fit = fit;
    this.inView = true;
    this.cost = 0; // ms until a drawn picture is out, a running mean
    this.coarse = 1;
    this.tries = 0;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(fov, 1, 0.1, 150);
    this.camera.up.set(0, 0, 1); // physics: z is up
    this.renderer = new THREE.WebGLRenderer({ antialias: true, powerPreference: "low-power" });
    this.setFineness(1);

    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    canvas.title = "Drag to turn. Click, then use the wheel to zoom.";
    holder.append(canvas);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    canvas.style.touchAction = "pan-y"; // a finger moving up or down scrolls the page, as it does everywhere else
    this.controls.addEventListener("change", () => this.invalidate());
    // The wheel scrolls the page until a person has clicked the picture.
    holder.addEventListener(
      "wheel",
      (event) => {
        if (holder.getRootNode().activeElement !== canvas) event.stopPropagation();
      },
      { capture: true, passive: true },
    );

    canvas.addEventListener("webglcontextlost", () => {
      if (this.disposed) return;
      this.lost = true;
      this.note("The browser took this picture's graphics memory away. It comes back by itself, or reload the page.");
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      this.note("");
      this.invalidate();
    });

    this.resizing = new ResizeObserver(() => this.resize());
    this.resizing.observe(holder);
    this.seeing = new IntersectionObserver(([entry]) => {
      this.inView = entry.isIntersecting;
      this.invalidate();
    });
    this.seeing.observe(holder);
  }

  note(sentence) {
    this.noteElement?.remove();
    if (!sentence) return;
    this.noteElement = document.createElement("p");
    this.noteElement.className = "note";
    this.noteElement.setAttribute("role", "alert");
    this.noteElement.textContent = sentence;
    this.holder.append(this.noteElement);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height) return;
    this.width = width;
    this.height = height;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.fit(this.camera.aspect);
    this.camera.updateProjectionMatrix();
    this.draw(); // now, not at the next frame: a new size empties the canvas
  }

  invalidate() {
    this.asked = true;
    this.again();
  }

  again() {
    if (!this.disposed) this.request ||= requestAnimationFrame(this.frame);
  }

  frame = (now) => {
    this.request = 0;
    if (this.disposed || !this.holder.isConnected) return;
    if (this.moving && !this.costed && !this.simple) {
      // The first frame after a drawn one comes late by what the drawing took.
      this.cost += 0.15 * (Math.min(now - this.drawnAt, 250) - this.cost);
      this.costed = true;
      if (this.cost > COARSER_MS && this.coarse > COARSEST) this.setCoarse(Math.max(this.coarse * STEP, COARSEST));
      else if (this.cost < FINER_MS && this.coarse < 1 && this.tries++ < MOST_TRIES) this.setCoarse(Math.min(this.coarse / STEP, 1));
    }
    if (this.costed) slow = this.cost > SLOW_MS || this.coarse < 1;
    const held = slow && now - inputAt < HAND_MS;
    if (held) {
      if (!this.asked || anyDrawnAt === now || now - this.drawnAt < HELD_MS) return this.again();
    }
    if (!held && this.moving && this.cost > SLOW_MS && now - this.drawnAt < REST * this.cost) return this.again();
    this.asked = false;
    this.moving = this.tick(now);
    if (this.inView) {
      this.setFineness(held ? HAND_COARSE : this.moving ? this.coarse : 1);
      this.setSimple(held);
      this.draw();
      this.drawnAt = anyDrawnAt = now;
      this.costed = false;
    }
    if (this.moving || held) this.again(); // held: once more, and fine, when the hand lets go
  };

  setCoarse(share) {
    this.coarse = share;
    this.cost = (COARSER_MS + FINER_MS) / 2; // unknown again
  }

  setFineness(share) {
    const ratio = share * Math.min(devicePixelRatio, MAX_PIXEL_RATIO);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  setSimple(simple) {
    if (simple === this.simple) return;
    this.simple = simple;
    this.renderer.shadowMap.autoUpdate = !simple;
    this.scene.traverse((object) => {
      if (object.isLineSegments2 && object.geometry.instanceCount > LONG_LINE) object.layers.set(simple ? 1 : 0);
    });
  }

  draw() {
    if (this.disposed || this.lost || !this.width) return;
    this.beforeDraw?.();
    this.renderer.render(this.scene, this.camera);
  }

  dispose() {
    if (this.disposed) return;
    this.disposed = true;
    cancelAnimationFrame(this.request);
    this.resizing.disconnect();
    this.seeing.disconnect();
    this.controls.dispose();
    this.scene.traverse((object) => {
      object.geometry?.dispose();
      for (const material of [object.material ?? []].flat()) {
        material.map?.dispose();
        material.dispose();
      }
      object.shadow?.dispose?.();
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

// A browser without WebGL gets a sentence instead of a picture.
export function tryStage(holder, options) {
  try {
    return new Stage(holder, options);
  } catch {
    const note = document.createElement("p");
    note.className = "note";
    note.textContent = "This picture needs WebGL, which this browser does not offer: turn on hardware acceleration, or try another.";
    holder.append(note);
    return null;
  }
}
