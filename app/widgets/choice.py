"""A choice of one of several, by buttons."""

import param

from app.borrowed import at_once
from app.bundle import Bundled


class Choice(Bundled):
    """One of several is chosen; what stands for each is a text or a whole number."""

    label = param.String(default="", doc="Before the buttons; also for screen readers.")
    options = param.Dict(default={}, doc="{word on the button: value}.")
    value = param.Parameter(doc="One of the values.")

    def __init__(self, options, value, label="", **layout):
        super().__init__(options=options, value=value, label=label, **({"margin": 0} | layout))
        at_once(self, "value")

    @classmethod
    def of(cls, owner, name, options, **layout):
        """The choice of a parameter, which it follows."""
        made = cls(options, getattr(owner, name), **layout)
        made.param.watch(lambda event: setattr(owner, name, event.new), "value")
        owner.param.watch(lambda event: setattr(made, "value", event.new), name)
        return made
