"""Models and views put together as on the page, but without a page: every request is carried out at once."""

import re
from dataclasses import replace
from functools import cache, wraps

from app.model.build.builder import Builder
from app.model.explorer import Explorer
from app.model.planes.planes import Planes, preset
from app.model.planes.run import solve
from app.tabs.planes.words import fate


def builder_of(explorer):
    """A Builder that sends its requests to this Explorer, and follows its scenes."""
    builder = Builder(explorer.scene, explorer.param.update)
    explorer.param.watch(lambda event: builder.follow(event.new), "scene")
    return builder


def planes_of(explorer, runs=None):
    """Visible Planes with the top of this Explorer, started as in Start."""
    explorer.param.update(given="hand", **{name: Explorer.param[name].default for name in Explorer.GIVEN["hand"]})
    planes = Planes(explorer, runs)
    planes.show()
    return planes


def choose(name, explorer, planes):
    """Chooses a preset of the three planes."""
    body, inputs = preset(name)
    builder_of(explorer).choose(body)
    planes.ask(**inputs)


def chosen(explorer, planes, name):
    """The Picture of a preset of the three planes."""
    choose(name, explorer, planes)
    assert not planes.picture.messages
    return planes.picture


def ran(usual, **settings):
    """A Picture with some settings changed, and the sentence about it, without markup."""
    picture = solve(replace(usual.settings, **settings))
    return picture, re.sub(r"<[^>]*>", "", fate(picture, "ordinary"))


@cache
def first_of(body):
    """The default Settings with this body."""
    explorer = Explorer()
    builder = builder_of(explorer)
    builder.choose(body)
    return planes_of(explorer).picture.settings


def of(body, **settings):
    """The default Settings with this body, and some changed."""
    return replace(first_of(body), **settings)


def keeping(made, make):
    """Wraps the __init__ of a class: each new object is stored in made, {class: newest object}."""

    @wraps(make)
    def making(view, *inputs, **named):
        made[type(view)] = view
        make(view, *inputs, **named)

    return making


class Shown:
    """Stands in for a Pacer, with a stored scene. asked: the requests; shown: functions that show scenes, and when."""

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
