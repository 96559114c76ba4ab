"""Models and views put together as on the page, but without a page: every request is carried out at once."""

from dataclasses import replace
from functools import wraps

from app.model.build.builder import Builder
from app.model.explorer import Explorer
from app.model.lab.lab import Lab, scene_of
from app.model.start import of_toy

PAPERS = "The paper's tippe top"


def builder_of(explorer):
    """A Builder that sends its requests to this Explorer, and follows its scenes."""
    builder = Builder(explorer.scene, explorer.set)
    explorer.param.watch(lambda event: builder.follow(event.new), "scene")
    return builder


def lab_of(explorer, runs=None):
    """A visible Lab with this start."""
    lab = Lab(runs, explorer)
    lab.show()
    return lab


def by_hand(body=PAPERS, **changes):
    """The Setup of a known body let go by a hand: 20 rev/s, 10 degrees, smoothed friction, for 5 s; and changes."""
    return replace(Explorer(**of_toy(body), given="hand").setup, **{"seconds": 5.0} | changes)


def ran(body=PAPERS, **changes):
    """(LabScene, sentences) of the runs of by_hand() on the three tables, and all that is said of the ordinary one."""
    scene = scene_of("three", by_hand(body, **changes))
    return scene, told(scene, "ordinary")


def told(scene, table):
    """All that is said of the run on a table."""
    if table in scene.refused:
        return scene.refused[table]
    return " ".join(f"{stage.headline} {stage.why}" for stage in scene.stories[table].stages)


def keeping(made, make):
    """Wraps the __init__ of a class: each new object is stored in made, {class: newest object}."""

    @wraps(make)
    def making(view, *inputs, **named):
        made[type(view)] = view
        make(view, *inputs, **named)

    return making


class Shown:
    """Stands in for a RenderScheduler, with a stored scene. asked: the requests; shown: functions that show scenes,
    and when."""

    def __init__(self, scene):
        self.scene, self.asked, self.shown, self.waits = scene, [], [], []

    def ask(self, **inputs):
        self.asked.append(inputs)

    def shows(self, show, when):
        self.shown.append((show, when))
        show(self.scene)

    def soon(self, make):
        make()

    def later(self, make):
        self.waits.append(make)

    def show(self, scene):
        """Shows another scene to all views; views that are still to be created come first."""
        self.scene = scene
        while self.waits:
            self.waits.pop(0)()
        for show, _ in self.shown:
            show(scene)
