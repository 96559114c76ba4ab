"""How the rolling top is played and looked at: what of it stands in a link, whoever draws it."""

from functools import partial

import param


class Playing(param.Parameterized):
    """What a person chose. A picture goes with it both ways: together(playing, picture)."""

    time = param.Number(default=0.0, doc="where it stands, in (R/g)^1/2, as of the last that a person moved it")
    playing = param.Boolean(default=True, doc="whether it plays")
    speed = param.Number(default=1 / 16, bounds=(0, None), doc="1 is the real top's own")
    camera = param.List(default=[], doc="azimuth, height and distance of a view that was chosen; empty: the first")
    show_track = param.Boolean(default=True)
    show_com_path = param.Boolean(default=True)
    show_force = param.Boolean(default=True)
    show_cone = param.Boolean(default=True)
    show_omega = param.Boolean(default=True)
    show_momentum = param.Boolean(default=True)
    follow = param.Boolean(default=True, doc="whether the camera goes along with the top")

    NAMES = ("time", "playing", "speed", "camera", "show_track", "show_com_path", "show_force", "show_cone",
             "show_omega", "show_momentum", "follow")  # fmt: skip

    @property
    def chosen(self) -> dict[str, object]:
        return {name: getattr(self, name) for name in self.NAMES}


def together(playing: Playing, picture: param.Parameterized, names: tuple[str, ...] = Playing.NAMES) -> None:
    """From now on a picture that has these parameters goes with a Playing, and the Playing with it."""
    picture.param.update(**{name: getattr(playing, name) for name in names})
    for one, other in ((playing, picture), (picture, playing)):
        one.param.watch(partial(_pass_on, other), list(names))


def _pass_on(other: param.Parameterized, *events: param.parameterized.Event) -> None:
    # not what came from there: two lists with a nan in them are never equal
    new = {event.name: event.new for event in events if getattr(other, event.name) is not event.new}
    other.param.update(**new)
