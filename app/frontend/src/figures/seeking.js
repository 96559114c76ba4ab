// Dragging on a figure sets the time of the clock, which is paused until the pointer is released.

export const LAB = "lab"; // the clock of the page's start

/** @param {number} t @param {boolean} held */
export const seek = (t, held, clock = LAB) => window.dispatchEvent(new CustomEvent(`tippe:seek:${clock}`, { detail: { t, held } }));

/** @param {Pick<Happened, "event_name">} event */
export const isDown = ({ event_name: name }) => name === "panstart" || name === "pan";

// What Bokeh calls it, but a click that comes soon after another is one too.
/** @param {Pick<Happened, "event_name">} event */
export const gestureOf = ({ event_name: name }) => (name === "doubletap" ? "tap" : name);

// Takes the time from the figure's time axis. path: its tags have the unit of that axis.
/** @param {{ clock?: string, path?: Source }} given @param {Happened} event */
export const seekAlong = ({ clock, path }, event) => seek(event.x / (path?.tags[0] ?? 1), isDown(event), clock);

// Bokeh calls this each time a figure is resized, the first time as soon as there is something to move. Only the first
// call may register listeners.
const followed = new WeakSet();

/** @param {object} followers */
export function isFollowed(followers) {
  if (followed.has(followers)) return true;
  followed.add(followers);
  return false;
}

// Calls move with each moment that the top which leads the clock shows.
/** @param {(moment: { t: number, index: number, playing: boolean, verdict: string }) => void} move @param {string} clock @param {AbortSignal} [life] */
export const followClock = (move, clock, life) => window.addEventListener(`tippe:clock:${clock}`, ({ detail }) => move(detail), { signal: life });
