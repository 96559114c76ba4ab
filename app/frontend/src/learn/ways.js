// Which way a top turns, seen from above and from its stem: two circles, each with an arrow whose length shows how
// fast.
import { SPIN, TURNING } from "../motion/curves.js";
import { drawn, part, say } from "../parts.js";

const SIZE = 64, R = 24, MOST = 300, HEAD = 9; // px, px, degrees, px

// An arrow on a circle about 0 that starts at its top and goes counterclockwise if share is positive, seen from
// outside.
/** @param {number} share -1 to 1, of the longest arrow */
export function arrow(share) {
  const degrees = MOST * Math.min(Math.abs(share), 1), round = share > 0 ? -1 : 1, end = (round * degrees * Math.PI) / 180;
  if (degrees < 4) return { line: "", head: "" };
  const [x, y] = [R * Math.sin(end), -R * Math.cos(end)], [dx, dy] = [round * Math.cos(end), round * Math.sin(end)];
  const corner = (along, across) => `${(x + along * dx - across * dy).toFixed(1)} ${(y + along * dy + across * dx).toFixed(1)}`;
  return {
    line: `M0 ${-R}A${R} ${R} 0 ${degrees > 180 ? 1 : 0} ${round > 0 ? 1 : 0} ${x.toFixed(1)} ${y.toFixed(1)}`,
    head: `M${corner(HEAD, 0)}L${corner(-2, HEAD / 2)}L${corner(-2, -HEAD / 2)}Z`,
  };
}

export class Ways {
  /** @param {Record<string, any>} texts */
  constructor(texts) {
    this.texts = texts;
    const wording = texts.drawn.spin;
    this.circles = [[wording.from_above, "turning", TURNING], [wording.from_stem, "own", SPIN]].map(([word, kind, column]) => {
      const line = drawn("path", { class: `line ${kind}` }), head = drawn("path", { class: `tip ${kind}` }), number = drawn("text", { class: "word", y: 5, "text-anchor": "middle" });
      const drawing = drawn("svg", { viewBox: `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`, role: "img", "aria-label": word }, drawn("circle", { class: "rim", r: R }), line, head, number);
      return { column, line, head, number, element: part("figure", {}, drawing, part("figcaption", {}, word)) };
    });
    this.element = part("div", { class: "ways" }, ...this.circles.map(({ element }) => element));
  }

  /** @param {import("../motion/curves.js").Curves} curves @param {number} t */
  at(curves, t) {
    const most = curves.at(0, SPIN);
    for (const { column, line, head, number } of this.circles) {
      const turns = curves.at(t, column), found = arrow(turns / most);
      line.setAttribute("d", found.line);
      head.setAttribute("d", found.head);
      number.textContent = say(this.texts, "{turns}", { turns: [Math.abs(turns), 0] });
    }
  }
}
