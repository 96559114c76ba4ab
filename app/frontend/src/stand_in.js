// Stand-ins for models: where there is no server, and for one that has not arrived yet; and the file with its numbers.
import { float32 } from "./data.js";

// A stand-in for the model that Panel passes to a component: values, with listeners that run when one is set.
/** @param {Record<string, any>} values @returns {any} */
export function modelOf(values) {
  const watchers = {};
  return new Proxy(values, {
    get: (_, /** @type {string} */ name) => (name === "on" ? (event, run) => (watchers[event] ??= []).push(run) : values[name]),
    set: (_, /** @type {string} */ name, value) => {
      const news = values[name] !== value;
      values[name] = value;
      if (news) watchers[name]?.forEach((run) => run());
      return true;
    },
  });
}

// Behaves like a model; become() puts the session's own model behind it.
/** @param {LabModel} values */
export function standIn(values) {
  const listeners = [], changed = new Set(); // what a person set before that
  /** @type {LabModel | null} */
  let own = null;
  const on = (name, run) => (own ? own.on(name, run) : listeners.push([name, run]));
  const model = new Proxy(/** @type {LabModel} */ ({}), {
    get: (_, name) => (name === "on" ? on : (own ?? values)[name]),
    set(_, name, value) {
      (own ?? values)[name] = value;
      if (!own) changed.add(name);
      return true;
    },
  });
  /** @param {LabModel} its */
  const become = (its) => {
    own = its;
    for (const [name, run] of listeners) its.on(name, run);
    for (const name of changed) its[name] = values[name];
    for (const [name, run] of listeners) if (name in values && !changed.has(name) && !isSame(values[name], its[name])) run();
  };
  return { model, become };
}

function isSame(a, b) {
  if (!(a instanceof ArrayBuffer)) return JSON.stringify(a) === JSON.stringify(b);
  const [one, other] = [a, b].map(float32);
  return one.length === other.length && one.every((value, i) => value === other[i]);
}

// Reads the arrays of the file; it stores them column by column, as second differences of whole numbers of steps. The
// result has them row by row.
/** @param {ArrayBuffer} bytes @returns {Record<string, ArrayBuffer>} */
export function numbersIn(bytes) {
  const all = new Uint8Array(bytes), end = all.indexOf(10), found = {};
  let at = end + 1;
  for (const [name, count, width, needed, steps] of JSON.parse(new TextDecoder().decode(all.subarray(0, end)))) {
    const columns = new Int32Array(bytes.slice(at, (at += 4 * count * needed))), rows = new Float32Array(count * width);
    for (let j = 0; j < needed; j++) {
      for (let i = 0, value = 0, rise = 0; i < count; i++) {
        rise += columns[j * count + i];
        value += rise;
        rows[i * width + j] = value / steps;
      }
    }
    found[name] = rows.buffer;
  }
  return found;
}
