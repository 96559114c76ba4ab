"""The fitted top in 3-D beside what was measured of it, on the film's clock, which the pictures over time follow."""

from app.bundle import pack
from app.text import say
from app.widgets.film_stage import FilmStage, put_motion


def film_stage():
    """Of the tab Measure."""
    return FilmStage(clock="film", label=say("measure.stage.label"), none=say("measure.stage.none"),
                     sizing_mode="stretch_width", height=300)  # fmt: skip


def show_film(stage, shown, outline):
    """Puts a Shown onto the stage. outline: (k, 2), of the body."""
    start = shown.t[0] + 0.6 * (shown.t[-1] - shown.t[0])
    label = say("measure.axis" if shown.azimuths else "measure.axis_tilt")
    put_motion(stage, shown.t, shown.motion, outline, start, measured=pack(shown.axis), measured_label=label)
