"""Pages to be printed for a class: how to film a top and measure the film, and which buttons programs have for it."""

from functools import partial

from app.text import listed, say, spoken
from app.widgets.download import Download

STYLE = """@page { size: A4; margin: 14mm }
body { font: 14px/1.38 system-ui, sans-serif; max-width: 760px; margin: 20px auto; padding: 0 16px; color: #1b2430 }
h1 { font-size: 24px; margin: 0 0 4px } h2 { font-size: 15px; margin: 10px 0 1px } p { margin: 0 }
code { font-size: 13px } @media print { body { font-size: 12.5px; margin: 0; padding: 0; max-width: none } }"""
FILES = {"film": ("measure.recipe", "film-a-top.html"), "sheets": ("measure.sheets_button", "from-your-program.html")}


def recipe(name="film"):
    """The text of an HTML file; name: a key of FILES."""
    title, intro, parts = (listed(f"measure.{name}")[part] for part in ("title", "intro", "parts"))
    told = "".join(f"<h2>{i}. {head}</h2><p>{says}</p>" for i, (head, says) in enumerate(parts, 1))
    return (f'<!doctype html><html lang="{spoken()}"><meta charset="utf-8">'
            f'<meta name="viewport" content="width=device-width"><title>{title}</title><style>{STYLE}</style>'
            f"<h1>{title}</h1><p>{intro}</p>{told}</html>")  # fmt: skip


def recipes(runs):
    """A button for each of these pages."""
    return [Download(runs, tuple, partial(_made, name), label=say(label), filename=file)
            for name, (label, file) in FILES.items()]  # fmt: skip


def _made(name):
    return recipe(name).encode()
