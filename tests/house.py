"""View-models and views put together as the page does it, but without a page: what is asked is done at once."""

import re
from dataclasses import replace
from functools import cache, wraps

from app.model.build.builder import Builder
from app.model.explorer import Explorer
from app.model.planes.planes import Planes, preset
from app.model.planes.run import solve
from app.tabs.planes.words import fate


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


def chosen(explorer, planes, name):
    """The Picture of a preset of the three planes."""
    choose(name, explorer, planes)
    assert not planes.picture.messages
    return planes.picture


def ran(usual, **settings):
    """A Picture with other settings than the first look's, and what is said of it, without its marks."""
    picture = solve(replace(usual.settings, **settings))
    return picture, re.sub(r"<[^>]*>", "", fate(picture, "sliding"))


@cache
def first_of(body):
    """The Settings of the first look with this body."""
    explorer = Explorer()
    builder = builder_of(explorer)
    builder.choose(body)
    return planes_of(explorer).picture.settings


def of(body, **settings):
    """The Settings of the first look with another body."""
    return replace(first_of(body), **settings)


def keeping(made, make):
    """The __init__ of a class, which puts what it makes into made, {class: the newest}."""

    @wraps(make)
    def making(view, *inputs, **named):
        made[type(view)] = view
        make(view, *inputs, **named)

    return making


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
