// A number by which a phone is recognised after a reload.
const KEY = "tippe:phone";

const drawn = () => Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");

/** @param {Pick<Storage, "getItem" | "setItem">} kept */
export function markOf(kept) {
  try {
    let mark = kept.getItem(KEY);
    if (!mark || !/^[0-9a-f]{32}$/.test(mark)) kept.setItem(KEY, (mark = drawn()));
    return mark;
  } catch {
    return drawn(); // the browser may not store anything
  }
}

/** @param {Pick<Rendering<PhoneModel>, "model">} rendering */
export function renderPhone({ model }) {
  model.mark = markOf({ getItem: (key) => localStorage.getItem(key), setItem: (key, mark) => localStorage.setItem(key, mark) });
}
