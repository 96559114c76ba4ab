// A hand on a figure puts the clock to another time, where it stands as long as the hand is down.

/** @param {number} t @param {boolean} held */
export function seek(t, held, clock = "") {
  window.dispatchEvent(new CustomEvent(`tippe:seek${clock && `:${clock}`}`, { detail: { t, held } }));
}

/** @param {Pick<Happened, "event_name">} event */
export const isDown = ({ event_name: name }) => name === "panstart" || name === "pan";

// By the place along the time of a figure. path: has the unit of that time.
/** @param {{ clock?: string, path?: Source }} given @param {Happened} event */
export function seekAlong({ clock, path }, event) {
  seek(event.x / (path?.tags[0] ?? 1), isDown(event), clock);
}

// Each new size of a figure asks to have it follow the clock, the first as soon as there is something to move: what is
// asked for once is done once.
const followed = new WeakSet();

/** @param {object} followers */
export function isFollowed(followers) {
  if (followed.has(followers)) return true;
  followed.add(followers);
  return false;
}

/** @param {(t: number) => void} move */
export function followClock(move, clock = "") {
  window.addEventListener(`tippe:clock${clock && `:${clock}`}`, ({ detail: { t } }) => move(t));
}
