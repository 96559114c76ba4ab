"""What the components in the browser share: the JavaScript that hatch_build.py bundled, three.js included; words. And
what Bokeh calls in it.

Panel serves only what lies beside or below a component's own module, so this one is beside static/.
"""

from pathlib import Path

import numpy as np
import param
from bokeh.models import CustomJS

from app.borrowed import Direct
from app.text import listed
from app.together import set_together

BUNDLE = Path(__file__).parent / "static" / "tippe.js"


def pack(values):
    """The float32 bytes, row by row, that the array parameters of components take."""
    return np.asarray(values, "<f4").tobytes()


# It runs a function of frontend/src/figures/callbacks.js: `run` names it, and `given` is its first argument.
CALL = Path(__file__).with_name("call.js").read_text(encoding="utf-8")


def call(run, **given):
    """A callback of a Bokeh model."""
    return CustomJS(args={"run": run, "given": given}, code=CALL, module=False)


def inlined(path):
    """A script as it stands in a page, between <script> and its end; its names are its own."""
    return f"{{\n{path.read_text(encoding='utf-8')}}}"


class Bundled(Direct):
    """A component whose JavaScript is in the bundle; one base class, so that a page loads the bundle once."""

    texts = param.Dict(default={}, constant=True, doc="What it says by itself: under SAYS in browser.toml.")
    SAYS = ()  # the tables of its words, beside the one of its own name
    REGIMES = ""  # and a table in regimes.toml, which it calls `regimes`
    _last = None

    _bundle = BUNDLE

    def __init__(self, **params):
        super().__init__(**({"texts": self.says()} | params))

    def tell(self, **values):
        """Takes several values as one change."""
        set_together(self, **values)

    def is_new(self, what):
        """Whether this is not what was put into it last; from now on it is."""
        new, self._last = self._last is not what, what
        return new

    @classmethod
    def says(cls, language=None):
        """Its texts in a language, the page's own where none is given."""
        known, texts = listed("browser", language), {}
        for name in (*cls.SAYS, cls.__name__):
            texts |= known.get(name, {})
        return texts | ({"regimes": listed(f"regimes.{cls.REGIMES}", language)} if cls.REGIMES else {})
