// One sketch of each symbol, the same everywhere: a top on the table, and what the symbol means in blue.

const FRAME = (parts) => `<svg viewBox="0 0 132 92" width="132" height="92" aria-hidden="true" fill="none" stroke-linecap="round">${parts}</svg>`;
const pale = (d) => `<path d="${d}" stroke="var(--faint)" stroke-width="1.5"/>`;
const ink = (d) => `<path d="${d}" stroke="var(--link)" stroke-width="2.5"/>`;
const letter = (x, y, text) => `<text x="${x}" y="${y}" font-size="14" font-family="Georgia, serif" font-style="italic" fill="var(--ink)">${text}</text>`;
const dot = (x, y) => `<circle cx="${x}" cy="${y}" r="2.5" fill="var(--ink)"/>`;
// the head of an arrow that ends at (x, y), along the unit vector (dx, dy)
const head = (x, y, dx, dy) => `M${x - 7 * dx - 4 * dy} ${y - 7 * dy + 4 * dx}L${x} ${y}L${x - 7 * dx + 4 * dy} ${y - 7 * dy - 4 * dx}`;

// O at (60, 48), 30 px above the contact C at (60, 78); axis 3 leans 30 degrees to the right, G is below O on it
const table = pale("M10 78H122"), ball = pale("M30 48a30 30 0 1 0 60 0a30 30 0 1 0 -60 0");
const axis = pale("M50 65.3L82 10"), top = table + ball + axis, upright = pale("M60 78V6");
const around = (x, y, rx, tilt) => `<path d="M${x - rx} ${y}a${rx} 6 0 1 0 ${2 * rx} 0" transform="rotate(${tilt} ${x} ${y})" stroke="var(--link)" stroke-width="2.5"/>`;
const spin = around(76, 20, 13, 30) + ink(head(88, 26, 0.2, -1)), cone = ink("M60 78L44 44M60 78L76 44M44 44H76");
const graph = pale("M20 80V12M20 80H120");

/** @type {Record<string, string>} by the names in controls.toml */
const drawn = {
  angle: top + upright + ink("M60 18a30 30 0 0 1 15 4") + letter(64, 14, "θ"),
  theta_dot: top + ink("M82 10Q98 16 104 30") + ink(head(104, 30, 0.4, 0.9)),
  omega3: top + spin + letter(96, 22, "ω₃"),
  omega2: top + ink(`M60 48L92 66.5${head(92, 66.5, 0.87, 0.5)}`) + letter(96, 66, "2′"),
  K_J: top + ink("M60 78L40 12") + around(43, 22, 13, -17) + dot(54, 58.4) + dot(60, 78) + letter(38, 66, "G") + letter(66, 90, "C"),
  K_R: top + spin + ink("M48 84H72") + letter(10, 90, "u = 0"),
  energy: graph + ink("M24 22C44 96 84 96 112 22") + pale("M32 46H106") + letter(4, 50, "E"),
  height: graph + ink("M34 80C46 22 90 22 104 80") + letter(108, 92, "θ"),
  normal: top + ink(`M60 78V44${head(60, 44, 0, -1)}`) + letter(66, 60, "F"),
  ratio: top + cone + ink(`M60 78L70 50${head(70, 50, 0.34, -0.94)}`),
  mu: top + cone,
  slip: top + ink(`M60 84H94${head(94, 84, 1, 0)}`) + letter(98, 90, "u"),
  a: top + ink("M60 48L54 58.4") + dot(60, 48) + dot(54, 58.4) + letter(66, 48, "O") + letter(40, 66, "G"),
  I1: table + ball + ink("M28 29.5L80 59.5") + around(80, 59.5, 10, 120),
  I3: table + ball + ink("M50 65.3L82 10") + around(76, 20, 13, 30),
  time: pale("M66 46m-30 0a30 30 0 1 0 60 0a30 30 0 1 0 -60 0") + ink("M66 46V24M66 46L82 54"),
  eps: graph + ink("M20 80C40 40 60 30 116 28"),
  patch: top + ink("M50 78a10 4 0 1 0 20 0a10 4 0 1 0 -20 0"),
  gamma: graph + ink("M20 80L110 24"),
};
// Other names of the same quantity.
const SAME = { theta: "angle", tilt: "angle", spin: "omega3", seconds: "time", mu_s: "mu", mu_k: "mu" };

/** @param {string} name of a symbol in controls.toml @returns {string | undefined} the sketch, an SVG */
export function sketchOf(name) {
  const parts = drawn[name] ?? drawn[SAME[name]];
  return parts && FRAME(parts);
}
