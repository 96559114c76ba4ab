"""What happened in a run, and when; clicking an entry sets the clock to it."""

import param

from app.bundle import Bundled


class EventList(Bundled):
    """The list, which is drawn in the browser."""

    clock = param.String(constant=True, doc="The clock that is set to the moment that is clicked.")
    rows = param.List(default=[], doc="[t, when, what, the state then, as HTML], in order, t in the unit of the clock")
