"""What others published, and common explanations: why Coulomb's law alone turns no top over, and results with links
that open them in the Lab; docs/published.md has the same links."""

import numpy as np
import param

from app.bundle import Bundled, pack
from app.model import published
from app.model.colours import ACCENT, GREY, INK
from app.model.runs import Run
from app.model.setup import TOYS
from app.state import names
from app.state.codecs import Body
from app.text import listed, say
from app.widgets.cards import card, grid, tall, words
from app.widgets.failure import unless_stopped

DRAWN = {"coulomb": (GREY, ""), "smoothed": (INK, "dashed"), "patch": (INK, ""), "stepped": (ACCENT, "dotted")}
"""{law: colour and dash} of the tilt; the last is that of the step that is chosen."""


def _opens(toy, spin, tilt, law="contact", **numbers):
    """The texts of a link. toy: a preset, or the text of a body; spin, tilt: as texts. A law of friction is seen at the
    level "Research"."""
    body = Body.text(TOYS[toy].shape) if toy in TOYS else toy
    level = {} if law == "contact" else {"level": "research"}
    return level | {"body": body, "spin": spin, "tilt": tilt, "law": law, "mu_k": ".3"} | numbers


COHENS, TOYS_OWN = ("Cohen's top", "15.915", "5.7296"), ("Leine and Glocker's toy", "28.648", "5.7296")
LAWS = {
    "coulomb": _opens(*COHENS, "coulomb", mu=".3"),
    "smoothed": _opens(*COHENS, "smoothed", eps=".2"),
    "patch": _opens(*COHENS, patch=".5"),
}
RESULTS = {
    "paper": {"level": "research", "table": "rough", "body": Body.text(TOYS["The paper's tippe top"].shape), "a": ".07",
              "I1": ".399", "I3": ".408", "by": "share", "KJ": "8.365", "KR": "10", "panel": "which"},
    "cohen": LAWS["smoothed"],
    "lighter": _opens("BareSphere_.025_.015_.2_.4_.32", *COHENS[1:], "smoothed", eps=".1"),
    "mujoco": _opens("MuJoCo's tippe top", "31.831", ".573", "smoothed", mu_k="1", eps=".1"),
    "threshold": _opens("Top S", "11.937", "5.7296", "viscous", gamma=".1329"),
    "leaves": _opens("Top S", "31.831", "5.7296", "viscous", gamma=".1329", panel="time"),
    "leine": _opens(*TOYS_OWN),
    "friedl": _opens("Friedl's first top", *TOYS_OWN[1:]),
    "ueda": _opens("BareSphere_.025_.015_.1_.4_.3", *COHENS[1:], "smoothed", eps=".1"),
    "exudyn": _opens("StemmedSphere_.2_.01_.2_.8133_.6667_.04_.24", "31.831", ".573", "smoothed", mu_k=".4", eps=".1"),
    "dojo": {},
}  # fmt: skip
ON_ICE = _opens(*TOYS_OWN, table="ice")
EXPLANATIONS = {"racket": LAWS["patch"], "conserved": ON_ICE, "space": ON_ICE, "reverses": _opens(*TOYS_OWN),
                "rough": _opens(*TOYS_OWN, table="rough"), "inertial": ON_ICE}  # fmt: skip


class Steps(Bundled):
    """Cohen's top by each law, and by Coulomb's in steps of a length that a slider chooses."""

    curves = param.List(default=[], doc="law, step (ms), name, says, link, colour, dash, and x, y: float32, of each")
    points = param.List(default=[], constant=True, doc="[word, s, degrees] read off Cohen's figure")

    @classmethod
    def says(cls, language=None):
        drawn, decimal = listed("learn.pictures", language), say("browser.NumberControls.decimal", language)
        return super().says(language) | {"steps": listed("published.view", language), "decimal": decimal,
                                         "drawn": drawn, "open": say("published.page.open", language)}  # fmt: skip


def curve_data(curve):
    """A Curve for the browser, with a sentence of it."""
    name = say(f"published.laws.{curve.law}", step=curve.step)
    key = "over" if not np.isnan(curve.over) else "stays" if np.isnan(curve.caught) else "caught"
    says = say(f"published.curve.{key}", over=curve.over, caught=curve.caught, most=curve.theta.max(),
               end=published.SECONDS)  # fmt: skip
    colour, dash = DRAWN[curve.law]
    link = names.link(**LAWS[curve.law]) if curve.law in LAWS else ""
    return {"law": curve.law, "step": curve.step, "name": name, "says": says, "colour": colour, "dash": dash,
            "link": link, "x": pack(curve.t), "y": pack(curve.theta)}  # fmt: skip


def steps_view(runs):
    points = [["", t, np.degrees(theta)] for t, theta in published.FIGURE]
    steps = Steps(points=points, sizing_mode="stretch_width", margin=0)

    def take(found):
        steps.curves = [curve_data(curve) for curve in found]

    runs.begin(Run(lambda run: published.curves(), unless_stopped(take)), "published")
    return steps


def opened(words, texts):
    link = f"<a href='{names.link(**texts)}'>{say('published.page.open')}</a>" if texts else ""
    return f"<p class='key' style='margin: 2px 0 14px'>{words} {link}</p>"


def published_view(runs):
    """runs: the page's Runs."""
    results = "".join(
        f"<h3 style='margin: 0'>{say(f'published.results.{name}.what')}</h3><p style='margin: 2px 0'>"
        f"{say(f'published.results.{name}.theirs')}</p>"
        + opened(f"<b>{say('published.page.here')}</b> {say(f'published.results.{name}.ours')}", texts)
        for name, texts in RESULTS.items()
    )
    explanations = "".join(
        f"<h3 style='margin: 0'>{say(f'published.explanations.{name}.wording')}</h3>"
        + opened(say(f"published.explanations.{name}.but"), texts)
        for name, texts in EXPLANATIONS.items()
    )

    def carded(key, *parts):
        return card(say(f"published.page.{key}"), *parts)

    why = (words(f"<p style='margin: 0 0 6px'>{say('published.page.cohen')}</p>"), steps_view(runs),
           words(f"<p style='margin: 6px 0 0'>{say('published.page.why')}</p>"))  # fmt: skip
    results = words(f"<p style='margin: 0 0 12px'>{say('published.page.intro')}</p>{results}")
    left = tall(carded("question", *why), carded("explanations", words(explanations)))
    return grid(left, carded("results", results))
