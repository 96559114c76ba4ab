"""The top of the run at the bead in 3-D, on a clock that the run's curve follows; each run begins anew."""

from app.text import say
from app.widgets.film_stage import FilmStage, put_motion

CLOCK = "map"


def map_stage():
    """Of the tab Maps."""
    return FilmStage(clock=CLOCK, label=say("maps.stage.label"), none=say("maps.stage.none"),
                     sizing_mode="stretch_width", height=260)  # fmt: skip


def show_run(stage, found, outline):
    """Puts a Found onto the stage; outline: of its body."""
    put_motion(stage, found.t, found.film, outline, 0.0)
