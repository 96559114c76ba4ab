import assert from "node:assert/strict";

export function near(found, wanted, within = 1e-6) {
  const [a, b] = [[found].flat(), [wanted].flat()];
  assert.equal(a.length, b.length);
  a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) <= within, `[${a}] is not [${b}]`));
}

// Bytes of a motion as Python packs them: the given values of each row, zeros for the others.
export function motion(rows) {
  const filled = rows.map(({ t, quaternion = [0, 0, 0, 1], contact = [0, 0], com = [0, 0, 0], theta = 0, force = [0, 0, 0], omega = [0, 0, 0], momentum = [0, 0, 0], regime = 0 }) =>
    [t, ...quaternion, ...contact, ...com, theta, ...force, ...omega, ...momentum, regime]);
  return new Float32Array(filled.flat()).buffer;
}

// The parts of a browser that the sources need if nothing is drawn.
const pen = new Proxy({}, { get: () => () => {} });
const nothing = () => {};
export const element = () => ({
  style: {}, dataset: {}, classList: { toggle: nothing }, append: nothing, setAttribute: nothing, removeAttribute: nothing, addEventListener: nothing, getContext: () => pen,
});
globalThis.document = { createElement: element };
