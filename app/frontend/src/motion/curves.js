// One run over time, as numbers to draw: app/tabs/lab/lab.py says what each column contains.
import { float32, rowBefore, stepOf } from "../data.js";

const WIDTH = 8;
export const TABLES = ["ordinary", "rough", "ice"];
export const TIME = 0, TILT = 1, HEIGHT = 2, ENERGY = 3, HEAT = 4, SPIN = 5, TURNING = 6;

export class Curves {
  /** @param {Bytes} [bytes] */
  constructor(bytes) {
    this.rows = float32(bytes);
    this.count = Math.floor(this.rows.length / WIDTH);
  }

  get end() { return this.count ? this.value(this.count - 1, TIME) : 0; }

  /** @param {number} i @param {number} column */
  value(i, column) { return this.rows[i * WIDTH + column]; }

  // The last row at or before t.
  /** @param {number} t */
  row(t) {
    const last = this.count - 1;
    return last > 0 && t >= this.value(last, TIME) ? last : rowBefore(this.rows, t, WIDTH);
  }

  // Interpolates between two rows; constant before the first and after the last.
  /** @param {number} t @param {number} column */
  at(t, column) {
    if (!this.count) return NaN;
    const low = this.row(t), high = Math.min(low + 1, this.count - 1), from = this.value(low, TIME), to = this.value(high, TIME);
    const share = to > from ? Math.min(Math.max((t - from) / (to - from), 0), 1) : 0;
    return this.value(low, column) + share * (this.value(high, column) - this.value(low, column));
  }

  /** @param {number[]} columns @returns {[least: number, most: number]} */
  range(...columns) {
    let least = Infinity, most = -Infinity;
    for (let i = 0; i < this.count; i++) {
      for (const column of columns) {
        least = Math.min(least, this.value(i, column));
        most = Math.max(most, this.value(i, column));
      }
    }
    return [least, most];
  }

  // As the points of an SVG polyline.
  /** @param {(t: number) => number} x @param {(value: number) => number} y @param {number} column */
  points(x, y, column) {
    const points = Array(this.count);
    for (let i = 0; i < this.count; i++) points[i] = `${x(this.value(i, TIME)).toFixed(1)},${y(this.value(i, column)).toFixed(1)}`;
    return points.join(" ");
  }
}

// The last list that has begun; each starts with its time.
/** @param {any[][]} list @param {number} t */
export const latest = (list, t) => list.filter(([from]) => from <= t + 1e-9).at(-1) ?? list[0];

// Round numbers from least to most, about `count` of them.
/** @param {number} least @param {number} most @param {number} count */
export function ticks(least, most, count, step = stepOf((most - least) / count)) {
  const found = [];
  for (let i = Math.ceil(least / step - 1e-6); i * step <= most + 1e-3 * step; i++) found.push(i * step);
  return found;
}

// How many digits numbers at such distances need.
/** @param {number[]} marks */
export const digitsOf = (marks) => (marks.length > 1 ? Math.max(0, Math.ceil(-Math.log10(marks[1] - marks[0]) - 1e-9)) : 0);

const SLOW = 1 / 4, AFTER = 1 / 2, FASTEST = 8;
const LOOK = 0.6, SOON = 0.3, FIRST = 2, QUIET = 1.2, LONG = 3; // s

// How fast to play unless a person chose: slowly until shortly after the top has turned over, or for a while; then at
// half speed, and faster where nothing new happens for long.
/** @param {any[][]} events @param {number} t in s @param {number} end */
export function tempo(events, t, end) {
  if (!events.length) return SLOW;
  const over = events.filter(([, code]) => code === "over" || code === "stands-on-stem").slice(0, 2);
  const since = over.length ? over[over.length - 1][0] + LOOK : FIRST;
  if (t <= since) return SLOW;
  const before = events.filter(([at]) => at <= t).at(-1), next = events.find(([at]) => at > t);
  const from = Math.max(since, before ? before[0] + LOOK : 0), to = next ? next[0] - SOON : end;
  if (t <= from || t > to || to - from < QUIET) return AFTER;
  return Math.min(2 ** Math.max(Math.ceil(Math.log2((to - from) / LONG)), 0), FASTEST);
}

const SPARE = 4; // px: words are narrower than reckoned

// Where the words of events go, to the left or right of their lines: in full if there is room for all, otherwise in
// short, in two rows if one has no room for all, and if that is too little, the first ones without regard to the others.
/**
 * @param {[x: number, word: string, short: string][]} lines
 * @param {number} left @param {number} right
 * @param {(word: string) => number} wide its width in px
 * @returns {{ x: number, word: string, side: "start" | "end", row: number }[]}
 */
export function placed(lines, left, right, wide) {
  const [whole, short] = [1, 2].map((i) => lines.map((line) => /** @type {[number, string]} */ ([line[0], line[i]])));
  const ways = [1, 2].flatMap((rows) => [whole, lines, short].map((wording) => beside(wording, left, right, wide, rows)));
  ways.push(beside(short, left, right, wide, 2, true));
  return ways.reduce((best, found) => (found.length > best.length ? found : best));
}

// The same for given rows: each line gets the first of its words that there is room for.
/**
 * @param {[x: number, ...words: string[]][]} lines
 * @param {number} left @param {number} right
 * @param {(word: string) => number} wide
 * @param {number} rows
 * @param {boolean} [isFirst] whether the first ones may take the room of later lines
 */
function beside(lines, left, right, wide, rows, isFirst) {
  const taken = Array.from({ length: rows }, () => (isFirst ? [] : lines.map(([x]) => [x - 1, x + 1])));
  const occupied = Array.from({ length: rows }, () => /** @type {number[][]} */ ([]));
  const isFree = (row, from, to, x) => from >= left && to <= right && taken[row].every(([a, b]) => to < a || from > b)
    && occupied.slice(row).flat().every(([a, b]) => x < a || x > b - SPARE); // a line goes down from the row of its word
  return lines.flatMap(([x, ...words]) => {
    const ways = taken.flatMap((_, row) => words.flatMap((word) => ["start", "end"].map((side) => {
      const width = wide(word), from = side === "start" ? x + 3 : x - 4 - width;
      return { x, word, side: /** @type {"start" | "end"} */ (side), row, from, to: from + width + 1 };
    })));
    const way = ways.find(({ row, from, to }) => isFree(row, from, to, x));
    if (!way) return [];
    const { row, from, to, word, side } = way;
    taken[row].push([from, to]);
    occupied[row].push([from, to]);
    for (const below of taken.slice(row)) below.push([x - 1, x + 1]);
    return [{ x, word, side, row }];
  });
}
