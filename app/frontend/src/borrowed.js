// What is used here of Bokeh, Panel and three.js although their manuals do not promise it: it may go with any new version.
// All of it stands here, but for 1 and 2, which have to be done before the bundle is there: app/borrowed.js. The issues
// named are the libraries' own. tests/test_borrowed_browser.py fails where one of them has changed.

// The view of a figure that is drawn: promised since https://github.com/bokeh/bokeh/pull/13351.
/** @returns {any} */
const viewOf = (fig) => Bokeh.index.find_one(fig);

/** The element of a figure, none while it is not drawn. @param {Figure} fig @returns {HTMLElement | undefined} */
export const elementOf = (fig) => viewOf(fig)?.el;

// 3. Between values and px on the canvas of a figure. https://github.com/bokeh/bokeh/issues/3747
/** @param {Figure} fig @returns {{ x: PixelScale, y: PixelScale }} */
export function scalesOf(fig) {
  const { x_scale: x, y_scale: y } = viewOf(fig).frame;
  return { x, y };
}

/** 4. What the mouse and fingers act on, in px of which the scales are. No issue that we found. @param {Figure} fig @returns {HTMLElement} */
export const eventsOf = (fig) => viewOf(fig).canvas_view.events_el;

/** @param {Figure} fig @param {string} cursor in words of CSS */
export const setCursor = (fig, cursor) => (eventsOf(fig).style.cursor = cursor);

// 5. Bokeh takes a hand that rests for 300 ms before it pulls for one that presses, and pulls nothing. No figure here is
// pressed, so that none is in all time. No issue that we found.
/** @param {Figure} fig */
export function pressNever(fig) {
  viewOf(fig).canvas_view.ui_event_bus.ui_gestures.constructor.press_threshold = 2 ** 31 - 1;
}

// 6. three.js: a target whose colours are a screen's, not a texture's, is one of its headset's.
// https://github.com/mrdoob/three.js/issues/29429
/** @param {import("three").WebGLRenderTarget} target */
export const likeAScreen = (target) => Object.assign(target, { isXRRenderTarget: true });

// 7. What WebGL calls a target that three.js has drawn into. https://github.com/mrdoob/three.js/issues/33161
/** @param {import("three").WebGLRenderer} renderer @param {import("three").WebGLRenderTarget} target */
export const bufferOf = (renderer, target) => /** @type {any} */ (renderer.properties.get(target)).__webglFramebuffer;
