"""Whether the body on the bench turns over, in words beside it."""

import html
from functools import partial

from app.model.build.verdict import verdict
from app.model.runs import Run, Stopped
from app.text import say
from app.widgets.cards import words
from app.widgets.spelling import spelled

OLD = ".old { opacity: .45 } .verdict { min-height: calc(110px * var(--type, 1)) } h3 { margin: 8px 0 4px }"


class VerdictWords:
    """view: the words; runs: the page's Runs. show() is for each scene of a hand at rest."""

    def __init__(self, runs):
        self._runs, self._shape, self._said = runs, None, ""
        self.view = words(self._written(), style=OLD)

    def show(self, scene):
        """Computes it, where the body is another; until then what is there is old."""
        shape = scene.shape
        if shape is None or shape == self._shape:
            return
        self._shape = shape
        self.view.object = self._written("old")
        self._runs.begin(Run(lambda run: verdict(shape), partial(self._done, shape)), "verdict")

    def _done(self, shape, result):
        if isinstance(result, Stopped) or shape != self._shape:
            self._shape = None if shape == self._shape else self._shape  # to be asked again
            return
        if isinstance(result, Exception):
            raise result
        self._said = f"<h3>{html.escape(spelled(result.headline))}</h3><div>{html.escape(spelled(result.why))}</div>"
        self.view.object = self._written()

    def _written(self, kind=""):
        waits = f'<div role="status">{say("build.verdict.waits")}</div>' if kind or not self._said else ""
        return f'<div class="verdict">{waits}<div class="{kind}">{self._said}</div></div>'
