// Parts of Bokeh that we use although its documentation does not promise them: any new version may remove them. All are here
// except 1, which must run before the bundle has loaded: see app/borrowed.js. The issues are those of the library.
// tests/test_borrowed_browser.py fails if one of these parts has changed.

// The view of a figure. Public since https://github.com/bokeh/bokeh/pull/13351.
/** @returns {any} */
const viewOf = (fig) => Bokeh.index.find_one(fig);

/** The element of a figure, undefined while it is not drawn. @param {Figure} fig @returns {HTMLElement | undefined} */
export const elementOf = (fig) => viewOf(fig)?.el;

// 2. Converts between values and px on the canvas of a figure. https://github.com/bokeh/bokeh/issues/3747
/** @param {Figure} fig @returns {{ x: PixelScale, y: PixelScale }} */
export function scalesOf(fig) {
  const { x_scale: x, y_scale: y } = viewOf(fig).frame;
  return { x, y };
}

/** 3. The element that gets the mouse and touch events; the scales are in px of it. No issue that we found. @param {Figure} fig @returns {HTMLElement} */
export const eventsOf = (fig) => viewOf(fig).canvas_view.events_el;

/** @param {Figure} fig @param {string} cursor a CSS cursor */
export const setCursor = (fig, cursor) => (eventsOf(fig).style.cursor = cursor);

// 4. If a pointer rests for 300 ms before it moves, Bokeh takes that for a press and does not drag. No figure here uses
// presses, so a press never counts as one. No issue that we found.
/** @param {Figure} fig */
export const pressNever = (fig) => void (viewOf(fig).canvas_view.ui_event_bus.ui_gestures.constructor.press_threshold = 2 ** 31 - 1);
