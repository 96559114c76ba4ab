// A canvas with a camera that a person can turn: builds, resizes, draws on demand, and disposes of everything.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { atEnd } from "../life.js";
import { dress, part } from "../parts.js";
import { isHandOn } from "./hand.js";
import { letGo } from "./scene.js";

// Where WebGL is drawn by the processor, moving pictures get coarser until they are fast enough; a picture at rest is
// always drawn fine.
const SLOW_MS = 24; // a picture that takes longer than this to be drawn
export const REST = 1.2; // is followed by the next one after this many times as long
export const pace = { rest: REST };
const COARSER_MS = 34;
const FINER_MS = 14;
const STEP = 0.8;
const COARSEST = 0.6;
const MOST_TRIES = 4; // to return to finer pictures; then it stays as it is
const MAX_PIXEL_RATIO = 2;
const SAMPLES = 4;
const POLL_MS = 8;
const KEY_TURN = 0.1; // rad
const KEY_ZOOM = 1.1;

// There, controls have priority: while one is in use, a 3-D picture is drawn only if it has changed, and without what
// takes long: fine pixels, a new shadow, long wide lines.
const HAND_COARSE = 0.5;
const LONG_LINE = 300; // segments
// All materials give the colours of a screen, also to a render target: three.js would give those only to the screen itself.
// Colours of a background and of fog are numbers of a screen, too.
THREE.ShaderChunk.colorspace_fragment = "gl_FragColor = sRGBTransferOETF( gl_FragColor );";
// Copies a picture to the screen, pixel by pixel.
const COPY = {
  glslVersion: THREE.GLSL3, depthTest: false, depthWrite: false, blending: THREE.NoBlending,
  vertexShader: "in vec3 position; void main() { gl_Position = vec4(position, 1.0); }",
  fragmentShader: "precision highp float; uniform sampler2D picture; out vec4 colour;"
    + " void main() { colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }",
};
let inWork = 0; // pictures that have been started and are not on the screen yet
let slow = false; // whether the processor draws, as measured by any stage

export class Stage {
  /**
   * @param {HTMLElement} holder
   * @param {object} options
   * @param {string} options.label
   * @param {Record<string, any>} options.texts
   * @param {number} options.fov
   * @param {AbortSignal} options.life
   */
  constructor(holder, { label, texts, fov, life }) {
    this.holder = holder;
    // Set by the picture. tick runs before each frame and tells whether another one must follow; held while a control
    // is in use and the picture must not move.
    /** @type {(now: number, held: boolean) => boolean} */
    this.tick = () => false;
    /** @type {(aspect: number) => void} */
    this.fit = () => {}; // called after resizing
    this.shown = () => {}; // called when a picture is on the screen
    this.turned = () => {}; // called when a person has turned or zoomed
    this.beforeDraw = () => {};
    this.inView = true;
    this.width = this.height = 0; // px; not known yet
    this.cost = 0; // ms to draw a picture, a running mean
    this.coarse = 1;
    this.tries = 0;
    this.pictures = 0; // number of pictures that have been shown
    this.request = this.timer = 0;
    this.drawnAt = 0;
    /** @type {WebGLSync | null} */
    this.fence = null; // of a picture that has been started
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(fov, 1, 0.1, 150);
    this.camera.up.set(0, 0, 1); // as in physics: z points up
    // The render target has the antialiasing: drawing directly to a canvas blocks the whole page until it is done.
    this.renderer = new THREE.WebGLRenderer({ antialias: false, powerPreference: "low-power" });
    this.target = new THREE.WebGLRenderTarget(1, 1, { samples: SAMPLES });
    const copying = new THREE.RawShaderMaterial({ ...COPY, uniforms: { picture: { value: this.target.texture } } });
    this.copy = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), copying);
    this.copy.frustumCulled = false;
    this.fineness = 1;

    const canvas = this.renderer.domElement;
    dress(canvas, { tabindex: 0, role: "img", "aria-label": label, title: texts.hint });
    holder.append(canvas);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    this.listen(canvas, texts.lost);
    new ResizeObserver(() => this.resize()).observe(holder);
    new IntersectionObserver(([entry]) => {
      this.inView = entry.isIntersecting;
      this.invalidate();
    }).observe(holder);
    atEnd(life, () => this.dispose());
  }

  /** @param {HTMLCanvasElement} canvas @param {string} lost message for when the browser takes the picture away */
  listen(canvas, lost) {
    const { holder } = this;
    canvas.style.touchAction = "pan-y"; // a finger that moves up or down scrolls the page, as everywhere else
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("end", () => this.turned());
    let before = this.camera.position; // when a finger came, which may turn it a little before the browser scrolls the page
    this.controls.addEventListener("start", () => (before = this.camera.position.clone().sub(this.controls.target)));
    canvas.addEventListener("pointercancel", () => {
      this.camera.position.copy(before).add(this.controls.target);
      this.controls.update();
    }, { capture: true });
    // The wheel scrolls the page; with Ctrl, which touch pads send for a pinch, it zooms the picture.
    holder.addEventListener("wheel", (event) => event.ctrlKey || event.stopPropagation(), { capture: true, passive: true });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("webglcontextlost", () => {
      if (this.disposed) return;
      this.lost = true;
      this.forget();
      this.note(lost);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      this.note("");
      this.invalidate();
    });
  }

  // Shift and an arrow turn the picture, + and - zoom: the same as dragging and the wheel.
  /** @param {KeyboardEvent} event */
  key(event) {
    const { camera, controls } = this, { x, y, z } = camera.position.clone().sub(controls.target);
    const turn = event.shiftKey && { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const zoom = { "+": 1 / KEY_ZOOM, "=": 1 / KEY_ZOOM, "-": KEY_ZOOM }[event.key];
    if ((!turn && !zoom) || event.ctrlKey || event.altKey || event.metaKey) return; // the browser's own zoom, and screen readers'
    event.preventDefault();
    event.stopPropagation();
    const [across, down] = turn || [0, 0], far = Math.hypot(x, y, z) * (zoom ?? 1);
    const azimuth = Math.atan2(y, x) + KEY_TURN * across, from = Math.acos(z / Math.hypot(x, y, z)) + KEY_TURN * down;
    const polar = Math.min(Math.max(from, 0.05), controls.maxPolarAngle), s = far * Math.sin(polar);
    camera.position.set(s * Math.cos(azimuth), s * Math.sin(azimuth), far * Math.cos(polar)).add(controls.target);
    controls.update(); // keeps within its limits
    this.invalidate();
    this.turned();
  }

  /** @param {string} sentence */
  note(sentence) {
    this.noteElement?.remove();
    this.noteElement = sentence && part("p", { class: "note", role: "alert" }, sentence);
    if (sentence) this.holder.append(this.noteElement);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height || this.disposed) return;
    this.width = width;
    this.height = height;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.fit(this.camera.aspect);
    this.camera.updateProjectionMatrix();
    if (!this.pictures) return this.invalidate();
    this.draw(); // now rather than in the next frame: resizing empties the canvas
    this.present();
  }

  invalidate() {
    this.requested = true;
    this.again();
  }

  again() {
    if (!this.disposed) this.request ||= requestAnimationFrame(this.frame);
  }

  // Waits outside the screen's frames: asking in each of them would make the page repaint for nothing.
  soon() {
    if (this.disposed) return;
    this.timer ||= setTimeout(() => {
      this.timer = 0;
      if (this.isReady(performance.now())) this.again();
      else if (this.fence || this.requested || this.moving || (this.simple && this.inView)) this.soon();
    }, POLL_MS);
  }

  /** @param {number} now in ms */
  isHeld = (now) => slow && isHandOn(now);

  // The shaders of the first picture are compiled in the background: compiling on demand blocks everything.
  isPrepared() {
    if (this.prepared) return true;
    const { renderer, scene, camera, target } = this;
    if (!this.compiling) {
      renderer.setRenderTarget(target);
      renderer.compile(scene, camera);
      renderer.setRenderTarget(null);
      renderer.compile(this.copy, camera);
      this.compiling = true;
    }
    return (this.prepared = /** @type {any[]} */ (renderer.info.programs).every((program) => program.isReady()));
  }

  /** @param {number} now in ms */
  isReady(now) {
    if (this.width && !this.isPrepared()) return false;
    if (this.fence) return this.isDrawn();
    if (this.isHeld(now)) return this.requested; // draws once more, and fine, when the control is released
    if (inWork) return false;
    const early = this.moving && this.cost > SLOW_MS && now - this.drawnAt < pace.rest * this.cost;
    return !early && (this.requested || this.moving || (this.simple && this.inView));
  }

  /** @param {number} now in ms */
  frame = (now) => {
    this.request = 0;
    if (this.disposed) return;
    if (!this.isReady(now)) return this.soon();
    if (this.fence) {
      this.learn(performance.now() - this.drawnAt);
      this.present();
      // The next picture starts in a later frame: what is shown on the screen waits for everything that was started
      // before it.
      return this.soon();
    }
    if (!this.holder.isConnected) return;
    const held = this.isHeld(now);
    this.requested = false;
    this.moving = this.tick(now, held);
    if (this.inView) {
      this.fineness = held ? HAND_COARSE : this.moving ? this.coarse : 1;
      this.setSimple(held);
      this.setSamples(slow && this.moving || held ? 0 : SAMPLES);
      this.draw();
    }
    this.soon();
  };

  // From the time of a picture: whether this machine is slow, and how coarse moving pictures must be.
  /** @param {number} took ms */
  learn(took) {
    if (this.simple || this.pictures < 3) return; // the first ones wait for their shaders
    this.cost += 0.15 * (Math.min(took, 250) - this.cost);
    slow = this.cost > SLOW_MS || this.coarse < 1;
    if (!this.moving) return;
    if (this.cost > COARSER_MS && this.coarse > COARSEST) this.setCoarse(Math.max(this.coarse * STEP, COARSEST));
    else if (this.cost < FINER_MS && this.coarse < 1 && this.tries++ < MOST_TRIES) this.setCoarse(Math.min(this.coarse / STEP, 1));
  }

  setCoarse(share) {
    this.coarse = share;
    this.cost = (COARSER_MS + FINER_MS) / 2; // not known yet
  }

  setSamples(samples) {
    if (samples === this.target.samples) return;
    this.target.samples = samples;
    this.target.dispose(); // three.js creates it again
  }

  setSimple(simple) {
    if (simple === this.simple) return;
    this.simple = simple;
    this.renderer.shadowMap.autoUpdate = !simple;
    this.scene.traverse((/** @type {any} */ object) => object.isLineSegments2 && object.geometry.instanceCount > LONG_LINE && object.layers.set(simple ? 1 : 0));
  }

  // Starts a picture, which the graphics process draws while the page goes on; present() puts it on the screen.
  draw() {
    if (this.disposed || this.lost || !this.width) return;
    const { renderer, target, gl } = this;
    const pixels = this.fineness * Math.min(devicePixelRatio, MAX_PIXEL_RATIO);
    target.setSize(Math.round(this.width * pixels), Math.round(this.height * pixels));
    this.beforeDraw();
    renderer.setRenderTarget(target);
    renderer.render(this.scene, this.camera);
    renderer.setRenderTarget(null);
    this.forget();
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0); // null if the browser has taken the context away
    if (this.fence) inWork += 1;
    gl.flush();
    this.drawnAt = performance.now();
  }

  // it is the last one that three.js has
  get gl() { return /** @type {WebGL2RenderingContext} */ (this.renderer.getContext()); }

  forget() {
    if (!this.fence) return;
    this.gl.deleteSync(this.fence);
    this.fence = null;
    inWork -= 1;
  }

  isDrawn() {
    const { gl } = this;
    return gl.getSyncParameter(/** @type {WebGLSync} */ (this.fence), gl.SYNC_STATUS) === gl.SIGNALED;
  }

  present() {
    if (!this.fence) return;
    const { renderer, target: { width, height } } = this, canvas = renderer.domElement;
    this.forget();
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    renderer.setViewport(0, 0, width, height);
    renderer.render(this.copy, this.camera);
    this.pictures += 1;
    this.holder.dataset.drawn = ""; // only now do labels have something to stand on
    this.shown();
  }

  // The present picture, fine and with the given width in px, on a canvas that the next picture overwrites.
  /** @param {number} wide */
  still(wide) {
    this.forget();
    this.setSimple(false);
    this.setSamples(SAMPLES);
    this.fineness = wide / (this.width * Math.min(devicePixelRatio, MAX_PIXEL_RATIO));
    this.draw();
    this.present();
    this.invalidate();
    return this.renderer.domElement;
  }

  dispose() {
    this.disposed = true;
    this.forget();
    cancelAnimationFrame(this.request);
    clearTimeout(this.timer);
    this.controls.dispose();
    for (const tree of [this.scene, this.copy]) letGo(tree);
    this.target.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

// A browser without WebGL shows a sentence instead of a picture.
/** @param {HTMLElement} holder @param {ConstructorParameters<typeof Stage>[1]} options */
export function tryStage(holder, options) {
  try {
    return new Stage(holder, options);
  } catch {
    holder.append(part("p", { class: "note" }, options.texts.no_webgl));
    return null;
  }
}
