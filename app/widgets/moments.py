"""What happened in a run, and when; clicking an entry sets the clock to it."""

import param

from app.bundle import Bundled


class Moments(Bundled):
    """The list, which is drawn in the browser."""

    clock = param.String(constant=True, doc="Which clock goes to the moment that is clicked.")
    rows = param.List(default=[], doc="[t, when, what, how it then was, as HTML] in turn, t as the clock has it")
