// What is used here of Bokeh, Panel and three.js although their manuals do not promise it: it may go with any new version.
// All of it stands here, but for what has to run before the bundle: first.html. tests/test_scripts.py looks whether the
// names are still there, and the tests in a browser whether they still do the same.

// The view of a figure that is drawn, with its scales and what hears of the mouse. Bokeh: no promised way from a model.
/** @returns {any} */
const viewOf = (fig) => Bokeh.index.find_one(fig);

/** The element of a figure, none while it is not drawn. @returns {HTMLElement | undefined} */
export const elementOf = (fig) => viewOf(fig)?.el;

// Between values and px on the canvas of a figure.
/** @returns {{ x: PixelScale, y: PixelScale }} */
export function scalesOf(fig) {
  const { x_scale: x, y_scale: y } = viewOf(fig).frame;
  return { x, y };
}

/** What the mouse and fingers act on, in px of which the scales are. @returns {HTMLElement} */
export const eventsOf = (fig) => viewOf(fig).canvas_view.events_el;

/** @param {string} cursor in words of CSS */
export const setCursor = (fig, cursor) => viewOf(fig).canvas_view.ui_event_bus.set_cursor(cursor);

// Bokeh takes a hand that rests for 300 ms before it pulls for one that presses, and pulls nothing. No figure here is
// pressed, so that none is in all time.
export function pressNever(fig) {
  viewOf(fig).canvas_view.ui_event_bus.ui_gestures.constructor.press_threshold = 2 ** 31 - 1;
}

// All models of a page, also those that no other one names. Bokeh has a getter, which makes a copy each time it is asked.
/** @returns {Map<string, any>} */
export const modelsOf = (doc) => doc._all_models;

// The sidebar of panel-material-ui's Page: Python hears of the width of a window only when it is open already.
export function closeSidebar() {
  for (const { data } of Bokeh.documents.flatMap((doc) => [...modelsOf(doc).values()])) {
    if (data?.attributes && "sidebar_open" in data.attributes) data.setv({ sidebar_open: false });
  }
}

// three.js: a target whose colours are a screen's, not a texture's, is one of its headset's.
/** @param {import("three").WebGLRenderTarget} target */
export const likeAScreen = (target) => Object.assign(target, { isXRRenderTarget: true });

// What WebGL calls a target that three.js has drawn into.
/** @param {import("three").WebGLRenderer} renderer @param {import("three").WebGLRenderTarget} target */
export const bufferOf = (renderer, target) => /** @type {any} */ (renderer.properties.get(target)).__webglFramebuffer;
