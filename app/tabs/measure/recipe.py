"""How to film a top and measure the film: one page, to be printed for a class."""

from app.text import listed, spoken

STYLE = """@page { size: A4; margin: 14mm }
body { font: 14px/1.38 system-ui, sans-serif; max-width: 760px; margin: 20px auto; padding: 0 16px; color: #1b2430 }
h1 { font-size: 24px; margin: 0 0 4px } h2 { font-size: 15px; margin: 10px 0 1px } p { margin: 0 }
code { font-size: 13px } @media print { body { font-size: 12.5px; margin: 0; padding: 0; max-width: none } }"""


def recipe():
    """The text of an HTML file."""
    title, intro, parts = (listed("measure.film")[name] for name in ("title", "intro", "parts"))
    told = "".join(f"<h2>{i}. {head}</h2><p>{says}</p>" for i, (head, says) in enumerate(parts, 1))
    return (f'<!doctype html><html lang="{spoken()}"><meta charset="utf-8">'
            f'<meta name="viewport" content="width=device-width"><title>{title}</title><style>{STYLE}</style>'
            f"<h1>{title}</h1><p>{intro}</p>{told}</html>")  # fmt: skip
