// The trajectory that Python computed, and interpolation between its samples.
import { Quaternion, Vector3 } from "three";
import { float32, rowBefore } from "../data.js";

// Columns of a row; app/widgets/top3d.py packs them in the same order.
const WIDTH = 21;
const T = 0, QUATERNION = 1, CONTACT = 5, COM = 7, THETA = 10, FORCE = 11, OMEGA = 14, MOMENTUM = 17, REGIME = 20;

export class Frames {
  /** @param {Bytes} [bytes] @param {number} [azimuth] rad: if given, the motion is turned on the table so that it begins with the axis leaning that way */
  constructor(bytes, azimuth) {
    this.bytes = bytes;
    this.rows = float32(bytes);
    this.count = Math.floor(this.rows.length / WIDTH);
    if (this.count && azimuth !== undefined) this.turn(azimuth);
  }

  turn(azimuth) {
    const rows = (this.rows = this.rows.slice()), [x, y] = this.contact(0);
    other.fromArray(rows, QUATERNION);
    const { x: east, y: north } = axis.set(0, 0, 1).applyQuaternion(other), angle = azimuth - Math.atan2(north, east);
    const turned = new Quaternion().setFromAxisAngle(axis.set(0, 0, 1), angle), c = Math.cos(angle), s = Math.sin(angle);
    const about = (at, x0, y0) => {
      const [u, v] = [rows[at] - x0, rows[at + 1] - y0];
      rows[at] = x0 + c * u - s * v;
      rows[at + 1] = y0 + s * u + c * v;
    };
    for (let row = 0; row < this.count * WIDTH; row += WIDTH) {
      other.fromArray(rows, row + QUATERNION).premultiply(turned).toArray(rows, row + QUATERNION);
      for (const place of [CONTACT, COM]) about(row + place, x, y);
      for (const vector of [FORCE, OMEGA, MOMENTUM]) about(row + vector, 0, 0);
    }
  }

  get start() { return this.count ? this.time(0) : 0; }

  get end() { return this.count ? this.time(this.count - 1) : 0; }

  /** @param {number} i */
  time(i) { return this.rows[i * WIDTH + T]; }

  /** @param {number} i @returns {number} rad */
  theta(i) { return this.rows[i * WIDTH + THETA]; }

  /** @param {number} i @returns {[number, number]} */
  contact(i) { return [this.rows[i * WIDTH + CONTACT], this.rows[i * WIDTH + CONTACT + 1]]; }

  /** @param {number} i @param {Put} put */
  com(i, put) {
    const at = i * WIDTH + COM;
    put(this.rows[at], this.rows[at + 1], this.rows[at + 2]);
  }

  // The position of t among the rows, as a fraction: 3.25 is a quarter of the way from row 3 to row 4.
  /** @param {number} t */
  place(t) {
    const last = this.count - 1;
    if (!(t > this.time(0))) return 0;
    if (t >= this.time(last)) return last;
    const low = rowBefore(this.rows, t, WIDTH);
    return low + (t - this.time(low)) / (this.time(low + 1) - this.time(low));
  }

  /** @param {number} t */
  nearest(t) { return Math.round(this.place(t)); }

  // The greatest length of a vector over all rows, which sets the scale of its arrow.
  largest(column) {
    let most = 0;
    for (let i = 0, at = column; i < this.count; i++, at += WIDTH) {
      most = Math.max(most, Math.hypot(this.rows[at], this.rows[at + 1], this.rows[at + 2]));
    }
    return most;
  }

  get scales() {
    return { force: this.largest(FORCE), omega: this.largest(OMEGA), momentum: this.largest(MOMENTUM) };
  }

  // The pose at a position: on a row exactly that of the row; between two, interpolated along the shortest rotation and
  // a straight line.
  /** @param {number} place @param {Pose} pose */
  read(place, pose) {
    const low = Math.min(Math.floor(place), this.count - 1);
    const high = Math.min(low + 1, this.count - 1);
    const share = place - low;
    const a = low * WIDTH, b = high * WIDTH, rows = this.rows;
    pose.quaternion.fromArray(rows, a + QUATERNION);
    if (share) pose.quaternion.slerp(other.fromArray(rows, b + QUATERNION), share);
    const mix = (column) => rows[a + column] + share * (rows[b + column] - rows[a + column]);
    const vector = (out, column) => out.set(mix(column), mix(column + 1), mix(column + 2));
    pose.contact.set(mix(CONTACT), mix(CONTACT + 1), 0);
    vector(pose.com, COM);
    pose.theta = mix(THETA);
    vector(pose.force, FORCE);
    vector(pose.omega, OMEGA);
    vector(pose.momentum, MOMENTUM);
    pose.regime = rows[a + REGIME];
  }
}

const other = new Quaternion(), axis = new Vector3();

// The centre O of the sphere. Usually it is above the contact; in the air or on the stem, G and the axis determine it.
/** @param {Pose} pose @param {number | null} a distance between O and G, if O may not be above the contact @param {Vector3} out */
export function centreOf(pose, a, out) {
  if (a === null) return out.set(pose.contact.x, pose.contact.y, 1);
  return out.set(0, 0, a).applyQuaternion(pose.quaternion).add(pose.com);
}

/** @returns {Pose} */
export function emptyPose() {
  const [contact, com, force, omega, momentum] = Array.from({ length: 5 }, () => new Vector3());
  return { quaternion: new Quaternion(), contact, com, theta: 0, force, omega, momentum, regime: 0 };
}
