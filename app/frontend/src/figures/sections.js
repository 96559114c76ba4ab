// The section through a top of the lesson at an instant.
const ALONG = 1.9; // R: length of axis 3 beyond O

// The paper's Fig. 4 at an instant, from points sent by Python: the outline, six lines and four points.
/** @typedef {[number, number]} Point */
/** @param {{ axis: Point, G: Point, foot: Point }} pose @param {{ across: Column, along: Column }} outline */
export function sectionAt({ axis, G, foot }, { across, along }) {
  const [e, f] = axis, tip = [ALONG * e, 1 + ALONG * f];
  const x = Array.from(across, (_, k) => across[k] * f + along[k] * e);
  const y = Array.from(across, (_, k) => 1 - across[k] * e + along[k] * f);
  // axis 3; the verticals through G and C; r from C to G; the lever arm of the torque about z, drawn above the points,
  // which are larger; the lever arm about axis 3
  const lines = [
    [-1.25 * e, 1 - 1.25 * f, ...tip], [G[0], 0, G[0], 1.7], [0, 0, ...G], [0, 1.5, G[0], 1.5], [0, 0, ...foot],
    [0, 0, 0, 1.7],
  ];
  return { x, y, lines, points: [[0, 1], G, [0, 0], tip] };
}
