"""View-models and views put together as the page does it, but without a page: what is asked is done at once."""

from app.model.build.builder import Builder
from app.model.explorer import Explorer
from app.model.planes.planes import Planes, preset


def builder_of(explorer):
    """A Builder that asks this Explorer, and follows its scenes."""
    builder = Builder(explorer.scene, explorer.param.update)
    explorer.param.watch(lambda event: builder.follow(event.new), "scene")
    return builder


def planes_of(explorer, runs=None):
    """Planes that are looked at, with this Explorer's top let go by a hand as Start has it."""
    explorer.param.update(given="hand", **{name: Explorer.param[name].default for name in Explorer.GIVEN["hand"]})
    planes = Planes(explorer, runs)
    planes.show()
    return planes


def choose(name, explorer, planes):
    """A preset of the three planes."""
    body, inputs = preset(name)
    builder_of(explorer).choose(body)
    planes.ask(**inputs)


class Shown:
    """In the place of a Pacer about a stored scene: asked has what was asked, shown what shows scenes, and when."""

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
        """Another scene, to all; what waited to be made comes first."""
        self.scene = scene
        while self.waits:
            self.waits.pop(0)()
        for show, _ in self.shown:
            show(scene)
