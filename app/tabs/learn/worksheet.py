"""A worksheet for a class, one page of A4, as a separate page that a browser prints; with the class's own top in it."""

from html import escape
from math import pi

from app.model.bodies import upright
from app.text import listed, say, spoken

WHY = {"height": ("why",), "arms": ("why",)}  # questions that also ask for a reason
STYLE = (
    "@page { size: A4; margin: 12mm } body { font: 10pt/1.3 sans-serif; color: #000;"
    " background: #fff; max-width: 182mm; margin: 0 auto; padding: 0 } h1 { font-size: 17pt; margin: 0 }"
    " h2 { font-size: 12pt; margin: 4mm 0 1mm }"
    " header { display: flex; justify-content: space-between; align-items: baseline } p { margin: 1mm 0 }"
    " section { break-inside: avoid; margin-top: 2.5mm } .line { display: flex; gap: 3mm; margin-top: 2.5mm }"
    " .line span { border-bottom: 0.3mm solid #555; flex: 1 } .box { border: 0.3mm solid #555; height: 28mm }"
    " .box svg { display: block; height: 100%; margin: 0 auto }"
)
LEANS = 25  # degrees, in the drawing


def worksheet(scene=None):
    """The whole page, in the page's language; scene: one of the class's own top, to have that on it."""

    def line(*names):
        return "".join(f'<div class="line">{escape(say(f"worksheet.{name}"))}<span></span></div>' for name in names)

    request = "".join(
        f"<section><b>{escape(words)}</b>{line('guess', 'saw', *WHY.get(name, ()))}</section>"
        for name, words in listed("worksheet.asked").items()
    )
    toy = "".join(f"<p>{escape(words)}</p>" for words in listed("worksheet.lines"))
    title, own = escape(say("worksheet.title")), _own(scene) if scene else ""
    drawn = _drawn(scene.profile) if scene else ""
    return (
        f'<!doctype html><html lang="{spoken()}"><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
        f"<header><h1>{title}</h1><span>{escape(say('worksheet.name'))} ______________________</span></header>"
        f"<p>{escape(say('worksheet.intro'))}</p>{own}{request}<h2>{escape(say('worksheet.toy'))}</h2>{toy}"
        f'<section><p>{escape(say("worksheet.draw"))}</p><div class="box">{drawn}</div></section></html>'
    )


def _own(scene):
    """Its numbers, and the spin from which it leaves the upright."""
    top, scales = scene.top, scene.scales
    change = upright(top)
    numbers = {"a": top.a, "I1": top.I1, "I3": top.I3, "R": 1e3 * scales.R, "M": 1e3 * scales.M}
    told = [say("worksheet.own.top", **numbers)]
    if top.a > 0 and change.stable in ("below", "always"):
        spin = scales.angular_velocity * change.spin / (2 * pi)
        told.append(say(f"worksheet.own.{change.stable}", spin=spin))
    return f"<p><b>{escape(say('worksheet.own.title'))}</b> {escape(' '.join(told))}</p>"


def _drawn(profile):
    """Its outline, leaning on the table, to draw into."""
    points = [*profile, *([-r, z] for r, z in profile[::-1])]
    size = 1.15 * max(float(abs(profile).max()), 1.0)
    shape = " ".join(f"{r:.3f},{-z:.3f}" for r, z in points)
    return (
        f'<svg viewBox="{-2 * size:.3f} {-size:.3f} {4 * size:.3f} {size + 1.1:.3f}" fill="none" stroke="#555" '
        f'stroke-width="0.03"><path d="M{-2 * size:.3f} 1h{4 * size:.3f}"/><polygon points="{shape}" '
        f'transform="rotate({LEANS})"/></svg>'
    )
