"""What others published, and common explanations: why Coulomb's law alone turns no top over, and results with links
that open them."""

import numpy as np
import param

from app.bundle import Bundled, pack
from app.model import published
from app.model.colours import COLOURS
from app.model.runs import Run
from app.state import names
from app.text import listed, say
from app.widgets.cards import card, grid, tall, words

DRAWN = {"coulomb": ("#5b6875", ""), "smoothed": (COLOURS["theta"], "dashed"), "patch": (COLOURS["normal"], ""),
         "stepped": ("#c0392b", "dotted")}  # fmt: skip


class Steps(Bundled):
    """Cohen's top by each law, and by Coulomb's in steps of a length that a slider chooses."""

    curves = param.List(default=[], doc="law, step (ms), name, says, colour, dash, and x, y: float32, of each")
    points = param.List(default=[], constant=True, doc="[word, s, degrees] read off Cohen's figure")

    @classmethod
    def says(cls, language=None):
        drawn, decimal = listed("learn.pictures", language), say("browser.NumberControls.decimal", language)
        return super().says(language) | {
            "steps": listed("published.view", language),
            "decimal": decimal,
            "drawn": drawn,
        }


def curve_said(curve):
    """A Curve for the browser, with a sentence of it."""
    name = say(f"published.laws.{curve.law}", step=curve.step)
    key = "over" if not np.isnan(curve.over) else "stays" if np.isnan(curve.caught) else "caught"
    says = say(f"published.curve.{key}", over=curve.over, caught=curve.caught, most=curve.theta.max(),
               end=published.SECONDS)  # fmt: skip
    colour, dash = DRAWN[curve.law]
    return {"law": curve.law, "step": curve.step, "name": name, "says": says, "colour": colour, "dash": dash,
            "x": pack(curve.t), "y": pack(curve.theta)}  # fmt: skip


def steps_view(runs):
    points = [["", t, np.degrees(theta)] for t, theta in published.FIGURE]
    steps = Steps(points=points, sizing_mode="stretch_width", margin=0)

    def take(found):
        if isinstance(found, Exception):
            raise found
        steps.curves = [curve_said(curve) for curve in found]

    runs.begin(Run(lambda run: published.curves(), take), "published")
    return steps


def opened(words, texts):
    link = f"<a href='{names.query(texts)}'>{say('published.page.open')}</a>" if texts else ""
    return f"<p class='key' style='margin: 2px 0 14px'>{words} {link}</p>"


def published_view(runs):
    """runs: the page's Runs."""
    results = "".join(
        f"<h3 style='margin: 0'>{say(f'published.results.{name}.what')}</h3><p style='margin: 2px 0'>"
        f"{say(f'published.results.{name}.theirs')}</p>"
        + opened(f"<b>{say('published.page.here')}</b> {say(f'published.results.{name}.ours')}", texts)
        for name, texts in published.RESULTS.items()
    )
    explanations = "".join(
        f"<h3 style='margin: 0'>{say(f'published.explanations.{name}.said')}</h3>"
        + opened(say(f"published.explanations.{name}.but"), texts)
        for name, texts in published.EXPLANATIONS.items()
    )

    def carded(key, *parts):
        return card(say(f"published.page.{key}"), *parts)

    why = (words(f"<p style='margin: 0 0 6px'>{say('published.page.cohen')}</p>"), steps_view(runs),
           words(f"<p style='margin: 6px 0 0'>{say('published.page.why')}</p>"))  # fmt: skip
    left = tall(carded("question", *why), carded("explanations", words(explanations)))
    return grid(
        left, carded("results", words(f"<p style='margin: 0 0 12px'>{say('published.page.intro')}</p>{results}"))
    )
