"""The derivation on the page: each equation typeset, both its sides now, and the symbols that can be pointed at."""

import numpy as np
import panel as pn
import param
from panel.custom import JSComponent

from app.model import derivation, stretches
from app.text import listed, say

PLANES = ("rough", "smooth")


class Lines(JSComponent):
    """The lines. The tables hold a row an instant of one nutation, t first; the browser picks the row of its clock.

    It listens to `tippe:clock:<clock>`, and says with `tippe:highlight:<clock>` what is pointed at:
    `{vector, start, label}`, a vector along 1', y, z from "com" or "contact", or null.
    """

    clock = param.String(default="", constant=True)
    lines = param.List(default=[], doc="number, tex, words, symbols, plane, and where the sides stand in its table")
    symbols = param.Dict(default={}, doc="name: texts, words, and where value and arrow stand in a table")
    words = param.Dict(default={})
    rough = param.Bytes(default=b"", doc="float64 rows of the rough plane")
    smooth = param.Bytes(default=b"", doc="float64 rows of the smooth plane")
    periods = param.List(default=[1.0, 1.0])
    widths = param.List(default=[1, 1])

    _esm = """
    const STYLE = `
      .lines { font: calc(14px * var(--type, 1))/1.45 system-ui, sans-serif; color: var(--ink, #22303c);
        --link: color-mix(in srgb, #0b5cad 60%, var(--ink, #22303c)) }
      .line { border-top: 1px solid var(--rule, #e7ebef); padding: 7px 0 }
      .line > .head { display: flex; gap: 8px; align-items: baseline; }
      .eq { overflow-x: auto; overflow-y: hidden; font-size: 1.07em; padding: 3px 0; min-width: 0 }
      math { font-family: 'STIX Two Math', 'Cambria Math', 'Latin Modern Math', 'DejaVu Math TeX Gyre', math }
      button { font: inherit; background: none; border: 1px solid #8a96a3; border-radius: 6px; color: var(--link);
        padding: 1px 7px; cursor: pointer; min-width: 46px }
      button[aria-expanded=true] { background: #0b5cad; color: white }
      .sides { color: var(--faint, #5b6875); font-size: 0.9em; font-variant-numeric: tabular-nums;
        overflow-wrap: anywhere }
      .sides b { font-weight: 600; color: var(--ink, #22303c) }
      .known { cursor: help; color: var(--link) } .known:hover { background: #fde9b8; color: #22303c }
      .symbols { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 230px), 1fr)); gap: 4px;
        margin-top: 5px; font-size: 0.9em } .symbols[hidden] { display: none }
      .symbols div { border-radius: 6px; padding: 2px 6px;
        background: color-mix(in srgb, var(--ink, #22303c) 6%, var(--card, white)) }
      .symbols div:focus { outline: 2px solid var(--link) }
      .tip { position: fixed; z-index: 99; pointer-events: none; background: #22303c; color: white; border-radius: 6px;
        border: 1px solid #8a96a3; padding: 4px 8px; font-size: 0.9em; max-width: 280px }`
    const bare = (node) => node.textContent.replace(/[\\s\\u2061\\u200b\\u2062]/g, "").replace("\\u20d7", "→")
    const figures = (value, digits) => Number.isFinite(value)
      ? String(Math.abs(value) < 1e-300 ? 0 : Math.abs(value) < 1e-4 ? value.toExponential(digits > 6 ? 3 : 1)
        : Number(value.toPrecision(digits))).replaceAll("-", "−") : "—"

    export function render({model, el}) {
      const root = document.createElement("div"), tip = document.createElement("div")
      const make = (parent, kind, name, text) => {
        const node = document.createElement(kind)
        if (name) node.className = name
        if (text !== undefined) node.textContent = text
        parent.append(node)
        return node
      }
      root.className = "lines"
      make(root, "style", "", STYLE)
      tip.className = "tip"
      tip.hidden = true
      const tables = {}
      let now = 0, shown = 0, due = null, pointed = null

      const read = () => ["rough", "smooth"].forEach((plane, i) => {
        const bytes = model[plane]
        const buffer = bytes instanceof ArrayBuffer ? bytes : bytes.slice().buffer
        tables[plane] = {values: new Float64Array(buffer), width: model.widths[i], period: model.periods[i]}
      })
      // the row nearest to the clock, in its nutation
      const row = (plane) => {
        const {values, width, period} = tables[plane], count = values.length / width
        const t = now - Math.floor(now / period) * period
        let low = 0, high = count - 1
        while (high - low > 1) {
          const middle = (low + high) >> 1
          if (values[middle * width] <= t) low = middle
          else high = middle
        }
        const i = t - values[low * width] <= values[high * width] - t ? low : high
        return values.subarray(i * width, (i + 1) * width)
      }
      const said = (part, digits) => part.length == 1 ? figures(part[0], digits)
        : "(" + Array.from(part, (x) => figures(x, 6)).join(", ") + ")"
      const valueOf = (name, plane) => {
        const {at, size} = model.symbols[name], part = row(plane).subarray(at, at + size)
        return said(part, 6)
      }
      const point = (name, plane, anchor) => {
        pointed = name && {name, plane, anchor}
        tell()
      }
      const tell = () => {
        let detail = null
        tip.hidden = !pointed
        if (pointed) {
          const {name, plane, anchor} = pointed, {arrow, start, says, label} = model.symbols[name]
          tip.textContent = `${says}, ${model.words.now} ${valueOf(name, plane)}`
          const box = anchor.getBoundingClientRect()
          tip.style.left = `${Math.max(4, Math.min(box.left, innerWidth - 290))}px`
          tip.style.top = `${box.bottom + 6}px`
          if (arrow >= 0 && plane == "rough")
            detail = {vector: Array.from(row(plane).subarray(arrow, arrow + 3)), start, label}
        }
        window.dispatchEvent(new CustomEvent(`tippe:highlight:${model.clock}`, {detail}))
      }

      const rows = model.lines.map((line) => {
        const box = make(root, "div", "line"), head = make(box, "div", "head")
        const button = make(head, "button", "", line.number), eq = make(head, "div", "eq")
        button.setAttribute("aria-expanded", "false")
        button.setAttribute("aria-label", `${line.number}: ${model.words.symbols}`)
        eq.tabIndex = 0  // it may have to be scrolled
        eq.setAttribute("role", "group")
        eq.setAttribute("aria-label", `${model.words.equation} ${line.number}`)
        const options = {output: "mathml", throwOnError: false}
        if (window.katex) window.katex.render(`\\\\displaystyle ${line.tex}`, eq, options)
        else eq.textContent = line.tex
        const marked = new Set()
        for (const node of eq.querySelectorAll("semantics > mrow *")) {
          if ([...marked].some((outer) => outer.contains(node))) continue
          const text = bare(node), name = line.symbols.find((s) => model.symbols[s].texts.includes(text))
          if (!name) continue
          marked.add(node)
          node.classList.add("known")
          node.dataset.symbol = name
          node.addEventListener("pointerenter", () => point(name, line.plane, node))
          node.addEventListener("pointerleave", () => point(null))
        }
        make(box, "div", "", line.words)
        const sides = make(box, "div", "sides"), list = make(box, "div", "symbols")
        sides.dataset.line = line.number
        list.hidden = true
        const entries = line.symbols.map((name) => {
          const entry = make(list, "div")
          entry.tabIndex = 0
          entry.setAttribute("role", "note")
          for (const [on, off] of [["pointerenter", "pointerleave"], ["focus", "blur"]]) {
            entry.addEventListener(on, () => point(name, line.plane, entry))
            entry.addEventListener(off, () => point(null))
          }
          return [name, entry]
        })
        button.addEventListener("click", () => {
          list.hidden = !list.hidden
          button.setAttribute("aria-expanded", String(!list.hidden))
          draw()
        })
        return {line, sides, list, entries}
      })
      root.append(tip)
      el.append(root)

      const draw = () => {
        for (const {line, sides, list, entries} of rows) {
          const values = row(line.plane), {at, size, scale} = line
          const left = values.subarray(at, at + size), right = values.subarray(at + size, at + 2 * size)
          const apart = Math.max(...left.map((x, i) => Math.abs(x - right[i]))) / scale
          const {words} = model
          sides.innerHTML = ""
          for (const [word, text] of [[words.left, said(left, 10)], [words.right, said(right, 10)],
                                      [words.differ, figures(apart, 2)]]) {
            sides.append(`${word} `)
            make(sides, "b", "", text)
            sides.append("  ")
          }
          sides.dataset.apart = apart
          if (!list.hidden) for (const [name, entry] of entries) {
            const {label, says} = model.symbols[name]
            entry.textContent = `${label}: ${says}, ${valueOf(name, line.plane)}`
          }
        }
        if (pointed) tell()
      }
      const tick = ({detail: {t}}) => {
        now = t
        due ??= setTimeout(() => {  // so that the last instant before a pause is shown too
          due = null
          shown = performance.now()
          if (root.isConnected && root.offsetParent) draw()
        }, Math.max(0, 200 - (performance.now() - shown)))
      }
      read()
      draw()
      model.on("periods", () => { read(); draw() })  // the last of what is sent together
      window.addEventListener(`tippe:clock:${model.clock}`, tick)
      model.on("remove", () => {
        clearTimeout(due)
        window.removeEventListener(`tippe:clock:${model.clock}`, tick)
      })
    }
    """


def rows(m, plane):
    """What stands in a table: [(key, (n, k))], all instants of a Window away from its ends."""
    inner = slice(stretches.EDGE, -stretches.EDGE)
    yield "t", m.t[inner, None]
    for name, symbol in derivation.SYMBOLS.items():
        for part, get in (("value", symbol.value), ("arrow", symbol.arrow)):
            if get is not None:
                found = np.asarray(get(m), dtype=float)
                yield f"{part} {name}", found.reshape(len(m.t), -1)[inner]
    for line in derivation.LINES:
        if line.plane == plane:
            _, left, right = derivation.both_sides(line, [m])
            yield f"left {line.number}", left
            yield f"right {line.number}", right


def table(parts, plane):
    """(values (n, k), {key: (first column, columns)})."""
    blocks = [dict(rows(m, plane)) for m in parts]
    at, places = 0, {}
    for key, block in blocks[0].items():
        places[key] = (at, block.shape[1])
        at += block.shape[1]
    return np.vstack([np.hstack(list(block.values())) for block in blocks]), places


LABELS = {"omega": "ω", "w1": "ω₁′", "w2": "ω₂′", "w3": "ω₃", "wz": "ω_z", "theta": "θ", "I1": "I₁", "I3": "I₃",
          "dI": "ΔI", "L_3": "L₃", "L_z": "L_z", "r3": "r₃", "rp": "r⊥", "vz": "v_z", "Fx": "F_x", "Fy": "F_y",
          "Fz": "F_z", "three": "3̂", "z": "ẑ", "Ep": "E′", "f1": "f₁", "f2": "f₂", "f3": "f₃"}  # fmt: skip


class Derivation:
    """The lines, kept at the scene's motion while they are looked at."""

    def __init__(self, clock):
        self._scene = None
        self._clock = clock
        self.place = pn.Column(sizing_mode="stretch_width", margin=0)

    def show(self, scene):
        if scene is self._scene:
            return
        self._scene = scene
        parts = {"rough": stretches.rolled(scene), "smooth": stretches.glided(scene)}
        tables = {plane: table(parts[plane], plane) for plane in PLANES}
        lines = []
        for line in derivation.LINES:
            values, places = tables[line.plane]
            (at, size), (after, _) = (places[f"{side} {line.number}"] for side in ("left", "right"))
            both = values[:, at : after + size]
            lines.append({"number": line.number, "tex": line.tex, "words": say(f"derivation.lines.{line.key}"),
                          "symbols": line.symbols.split(), "plane": line.plane, "at": at, "size": size,
                          "scale": 1 + float(np.nanmax(np.abs(both), initial=0.0))})  # fmt: skip
        places = tables["rough"][1]
        symbols = {
            name: {"texts": list(symbol.texts), "says": listed(f"derivation.symbols.{name}"), "start": symbol.start,
                   "label": LABELS.get(name, name), "at": places[f"value {name}"][0],
                   "size": places[f"value {name}"][1],
                   "arrow": places[f"arrow {name}"][0] if symbol.arrow else -1}
            for name, symbol in derivation.SYMBOLS.items()
        }  # fmt: skip
        # built anew with the scene: the numbers and the scales of the differences belong together
        self.place.objects = [Lines(
            clock=self._clock, lines=lines, symbols=symbols, words=listed("derivation.page"),
            rough=tables["rough"][0].tobytes(), smooth=tables["smooth"][0].tobytes(),
            widths=[tables[plane][0].shape[1] for plane in PLANES],
            periods=[parts[plane][-1].t[-stretches.EDGE - 1] for plane in PLANES], sizing_mode="stretch_width",
        )]  # fmt: skip
