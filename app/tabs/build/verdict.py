"""Whether the present body turns over, in words, and how its runs end at each spin."""

import html
from functools import partial

from app.model.arrival import MU, SPIN, TILT
from app.model.build.verdict import verdict
from app.model.colours import COLOURS
from app.model.ends import COLOUR_IN_LAB
from app.model.lab.ends import LIFE, SPINS, Ends, ends_once, known_ends
from app.model.runs import LATER, Run, Stopped
from app.model.setup import start_of, toy_of
from app.text import error_text, say, written
from app.widgets.cards import words
from app.widgets.failure import ended
from app.widgets.spelling import spelled
from tippe_core import TopError

OLD = """
.old { opacity: .6 } .verdict { min-height: calc(110px * var(--type, 1)) }
h3 { margin: 8px 0 4px; font-size: calc(28px * var(--type, 1)); font-weight: 600; line-height: 1.2 }
"""

TURNED = ("stands", "inverted")  # of these the least spin is said

STRIP = (
    """
.ends { position: relative; height: calc(20px * var(--type, 1)); margin: 4px 0 0 }
.end { position: absolute; top: 0; bottom: 0; background: var(--of) }
.end.mixed { background:
  repeating-linear-gradient(45deg, var(--end-stands, HIGH) 0 3px, var(--end-leans, LOW) 3px 6px) }
.mark { position: absolute; top: -5px; bottom: -5px; width: 3px; margin-left: -1px; background: var(--accent, ACCENT);
  outline: 1px solid var(--card) }
.under { position: relative; display: flex; justify-content: space-between; min-height: 1.5em; padding-top: 5px }
.under b { position: absolute; transform: translateX(-50%); background: var(--card);
  color: color-mix(in srgb, var(--accent, ACCENT) 60%, var(--ink)) }
.kinds { display: flex; flex-wrap: wrap; gap: 0 16px }
.kinds .end { position: static; display: inline-block; width: calc(12px * var(--type, 1));
  height: calc(12px * var(--type, 1)); margin-right: 6px; vertical-align: -1px;
  outline: 1px solid var(--rule) }
.strip { min-height: calc(92px * var(--type, 1)) }
""".replace("HIGH", COLOUR_IN_LAB["stands"])
    .replace("LOW", COLOUR_IN_LAB["leans"])
    .replace("ACCENT", COLOURS["accent"])
)  # in the light look, which sets no variables


class VerdictWords:
    """view: the words; strip: the ends of its runs over spin; runs: the page's Runs. show() is for each scene of a
    hand at rest; it also repeats computations that ended early."""

    def __init__(self, runs):
        self._runs, self._shape, self._html, self._requested = runs, None, "", None
        self.view = words(self._written(), style=OLD)
        self.strip = words(strip_of(None), style=STRIP)

    def show(self, scene):
        """Computes the verdict on a new body; until it is done, the previous one is shown as old."""
        shape = scene.shape
        if shape is None:
            return
        self._ends(start_of(toy_of(shape, scene.top, scene.scales), 0.0, TILT, MU))
        if shape == self._shape:
            return
        self._shape = shape
        self.view.object = self._written("old")
        self._runs.begin(Run(lambda run: verdict(shape), partial(self._done, shape)), "verdict")

    def _ends(self, key):
        """How the runs at all spins end: stored, or computed in a thread; the same as in the Lab."""
        if key == self._requested:
            return
        self._requested = key
        found = known_ends(key)
        self.strip.object = strip_of(found)
        if found is None:
            work = Run(lambda run: ends_once(key, look=run.look), partial(self._ended, key))
            self._runs.begin(work, "verdict-ends", LATER)

    def _ended(self, key, result):
        if key == self._requested:
            if isinstance(result, Ends):
                self.strip.object = strip_of(result)
            elif isinstance(result, TopError):
                self.strip.object = strip_of(None, say("build.verdict.strip_refused", why=error_text(result)))
            else:
                self._requested = None  # so that it is computed again
                self.strip.object = strip_of(None, ended(result))
        if isinstance(result, Exception) and not isinstance(result, Stopped | TopError):
            raise result

    def _done(self, shape, result):
        if shape != self._shape:
            return
        if isinstance(result, Exception):
            self._shape = None  # so that it is computed again
            self.view.object = self._written("old", ended(result))
            if not isinstance(result, Stopped):
                raise result
            return
        self._html = f"<h3>{html.escape(spelled(result.headline))}</h3><div>{html.escape(spelled(result.why))}</div>"
        self.view.object = self._written()

    def _written(self, kind="", why=""):
        waits = f'<div role="status">{why or say("build.verdict.waits")}</div>' if kind or not self._html else ""
        before = f"<div>{say('build.verdict.old')}</div>" if kind and self._html else ""
        return f'<div class="verdict">{waits}{before}<div class="{kind}">{self._html}</div></div>'


def strip_of(ends, why=""):
    """The ends of runs over the spin, with a mark at the spin of the verdict; None: they are not computed yet, or, with
    why, they cannot be."""
    low, high = float(SPINS[0]), float(SPINS[-1])
    says = say("build.verdict.strip", count=len(SPINS), seconds=LIFE, tilt=TILT, mu=MU)
    waits = html.escape(spelled(why or say("build.verdict.strip_waits")))
    at = f"{100 * (SPIN - low) / (high - low):.2f}%"
    mark = f'<i class="mark" style="left: {at}"></i>'
    parts = ends.segments if ends else ()
    stretches = [say("build.verdict.stretch", low=each.least, high=each.most, word=each.word) for each in parts]
    drawn = "".join(
        f'<span class="end {each.code}" title="{html.escape(spelled(stretch))}" style="{_colour(each.code)}'
        f'left: {100 * (each.least - low) / (high - low):.2f}%; '
        f'right: {100 * (high - each.most) / (high - low):.2f}%"></span>'
        for each, stretch in zip(parts, stretches, strict=True)
    )  # fmt: skip
    kinds = {}
    for each in parts:
        from_least = say("build.verdict.least", word=each.word, least=each.least)
        kinds.setdefault(each.code, html.escape(spelled(from_least if each.code in TURNED else each.word)))
    key = "".join(
        f'<span><i class="end {code}" style="{_colour(code)}"></i>{word}</span>' for code, word in kinds.items()
    )
    axis = f'<span>{low:.0f}</span><b style="left: {at}">{written(SPIN, ".1f")}</b><span>{high:.0f}</span>'
    return (
        f'<div class="strip"><div>{html.escape(spelled(says))}</div><div class="ends" role="img" '
        f'aria-label="{html.escape(spelled("; ".join(stretches))) or waits}">{drawn}{mark}</div>'
        f'<div class="under">{axis}</div><div class="kinds">{key or waits}</div></div>'
    )


def _colour(code):
    return f"--of: var(--end-{code}, {COLOUR_IN_LAB[code]}); " if code in COLOUR_IN_LAB else ""
