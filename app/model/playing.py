"""How the top on the Lab's stage is played and viewed: what a link stores of it."""

from functools import partial

import param


class Playing(param.Parameterized):
    """The playback settings. together(playing, picture) keeps those of a picture and these equal."""

    time = param.Number(default=0.0, doc="its time, in (R/g)^1/2, when it was last set by hand")
    playing = param.Boolean(default=True, doc="whether it plays")
    speed = param.Number(default=0.0, bounds=(0, None), doc="1 is that of the real top; 0: as fits its events")
    camera = param.List(default=[], doc="azimuth, height and distance of the chosen view; empty: the first one")
    show_track = param.Boolean(default=True)
    show_trace = param.Boolean(default=True)
    show_com_path = param.Boolean(default=True)
    show_force = param.Boolean(default=True)
    show_cone = param.Boolean(default=True)
    show_omega = param.Boolean(default=True)
    show_momentum = param.Boolean(default=True)
    follow = param.Boolean(default=True, doc="whether the camera follows the top")

    @property
    def chosen(self) -> dict[str, object]:
        return {name: value for name, value in self.param.values().items() if name != "name"}


def together(playing: Playing, picture: param.Parameterized) -> None:
    """From now on keeps the parameters of a picture and of a Playing equal, in both directions."""
    picture.param.update(**playing.chosen)
    for one, other in ((playing, picture), (picture, playing)):
        one.param.watch(partial(_pass_on, other), [*playing.chosen])


def _pass_on(other: param.Parameterized, *events: param.parameterized.Event) -> None:
    # not the values that came from there, because lists with a nan never compare equal
    new = {event.name: event.new for event in events if getattr(other, event.name) is not event.new}
    other.param.update(**new)
