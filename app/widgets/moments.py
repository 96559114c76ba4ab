"""What happened in a run, and when; a click puts the clock there."""

import param

from app.bundle import Bundled


class Moments(Bundled):
    """A list that is drawn in the browser."""

    clock = param.String(constant=True, doc="Which clock goes to the moment that is clicked.")
    rows = param.List(default=[], doc="[t, when, what, how it then was, as HTML] in turn, t as the clock has it")
