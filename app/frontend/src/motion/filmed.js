// What can be filmed: the Labs on the page; and which of its moments a film shows.
import { atEnd } from "../life.js";

const SAME = 1e-6; // s
export const WIDE = 1280, HIGH = 720; // px

/** @typedef {Omit<import("../lab/lab.js").Lab, "scene"> & { scene: any }} Filmed */
/** @type {Set<Filmed>} */
const labs = new Set(); // that are on the page

/** The Lab that is in sight. */
export const labInSight = () => [...labs].find(({ element, scene }) => element.clientWidth && scene?.end);

/** Says that a Lab is on the page. @param {Filmed} lab @param {AbortSignal} life */
export function canBeFilmed(lab, life) {
  labs.add(lab);
  atEnd(life, () => labs.delete(lab));
}

// The times in s at which a film has its pictures.
/**
 * @param {[from: number, to: number]} stretch in s @param {(t: number) => number} pace in units of real time
 * @param {number} rate pictures a second @param {number} most pictures
 */
export function timesOf([from, to], pace, rate, most) {
  const times = [];
  for (let t = from; t < to - SAME && times.length < most; t += pace(t) / rate) times.push(t);
  return times.length < most ? [...times, to] : times;
}
