"""A choice of one of several, by buttons."""

import param

from app.widgets.forms import Part


class Choice(Part):
    """One of several is chosen; what stands for each is a text or a whole number."""

    options = param.Dict(default={}, doc="{word on the button: value}.")
    value = param.Parameter(doc="One of the values.")
    SENDS = ("value",)

    def __init__(self, options, value, label="", **params):
        super().__init__(label, options=options, value=value, **params)

    @classmethod
    def of(cls, owner, name, options, **layout):
        """The choice of a parameter, which it follows."""
        made = cls(options, getattr(owner, name), **layout)
        made.on("value", lambda event: setattr(owner, name, event.new))
        owner.param.watch(lambda event: setattr(made, "value", event.new), name)
        return made
