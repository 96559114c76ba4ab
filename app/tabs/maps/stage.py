"""The top of the run at the bead in 3-D, with a clock that the run's curve follows; each run starts from the
beginning."""

from app.text import say
from app.widgets.film_stage import FilmStage, put_motion

CLOCK = "map"


def map_stage():
    """The stage of the tab Maps."""
    return FilmStage(clock=CLOCK, anew=True, label=say("maps.stage.label"), none=say("maps.stage.none"),
                     sizing_mode="stretch_width", height=260)  # fmt: skip


def show_run(stage, found, outline):
    """Shows a Found on the stage; outline: that of its body."""
    put_motion(stage, found.t, found.film, outline, 0.0)
