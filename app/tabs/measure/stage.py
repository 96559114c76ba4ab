"""The fitted top in 3-D beside the measured direction of its axis, on the film's clock, which the figures over time
follow."""

from app.bundle import pack
from app.text import say
from app.widgets.film_stage import FilmStage, clear_motion, put_motion


def film_stage():
    """The stage of the tab Measure."""
    return FilmStage(clock="film", label=say("measure.stage.label"), none=say("measure.stage.none"),
                     sizing_mode="stretch_width", height=300)  # fmt: skip


def show_film(stage, shown, outline):
    """Shows a Shown on the stage; None: nothing. outline: (k, 2), that of the body."""
    if shown is None:
        clear_motion(stage)
        return
    start = shown.t[0] + 0.6 * (shown.t[-1] - shown.t[0])
    label = say("measure.axis" if shown.azimuths else "measure.axis_tilt")
    put_motion(stage, shown.t, shown.motion, outline, start, measured=pack(shown.axis), measured_label=label)
