"""One top and one start: whatever view of the Lab is gone to has the start of the one that was left."""

from dataclasses import replace

import numpy as np
import pytest
from house import builder_of

from app.model.explorer import Explorer
from app.model.lab import Lab
from app.model.lab_run import TOYS, start_of
from app.model.planes import Planes
from app.state.codecs import Toy
from app.state.start import OneStart
from tippe_core import PRESETS, Constants, Top, TruncatedSphere

TOY = "Leine and Glocker's toy"


class Views:
    """The models of the views, and the room that is looked at."""

    def __init__(self, room="lab"):
        self.lab, self.explorer, self.room = Lab(), Explorer(), room
        self.start = OneStart(self.lab, self.explorer, self.explorer.param.update, builder_of(self.explorer))
        self.planes = Planes(self.explorer.scene)
        self.explorer.param.watch(lambda event: self.planes.see(event.new), "scene")
        self.start.have(self.planes)
        self.lab.rest = lambda: None  # where all spins end is no part of it

    def go(self, room):
        self.start.moved(self.room, room)
        self.room = room
        return self


@pytest.fixture
def views():
    return Views()


def hand(lab):
    return lab.toy, lab.spin, lab.tilt, lab.mu


def test_gripped_it_keeps_jelletts_constant_of_the_hand(views):
    """The impulse has no moment about the contact: the angular momentum about it, along the line to O, stays."""
    views.lab.ask(spin=20.0, tilt=30.0)
    views.go("roll")
    top, scales = TOYS[TOY].top, TOYS[TOY].shape.scales
    spin = 2 * np.pi * 20.0 * scales.time
    jellett = top.I3 * spin * (np.cos(np.radians(30)) - top.a)  # C_J of G at rest, spun about the axis
    state = views.explorer.scene.state
    across = top.I1 * state.omega2 * np.sin(state.theta)
    assert across + top.I3 * state.omega3 * (np.cos(state.theta) - top.a) == pytest.approx(jellett, rel=1e-12)
    assert state.theta == pytest.approx(np.radians(30)) and views.explorer.scene.top == top


def test_a_start_that_nobody_changed_comes_back_as_it_went(views):
    views.lab.ask(spin=-17.3, tilt=11.0, mu=0.21)
    before = hand(views.lab)
    for rooms in (["roll", "lab"], ["roll", "three-planes", "roll", "lab"], ["three-planes", "lab"]):
        for room in rooms:
            views.go(room)
        assert hand(views.lab) == before
    assert (views.planes.spin, views.planes.tilt, views.planes.mu, views.planes.by) == (-17.3, 11.0, 0.21, "spin")


def test_the_planes_do_what_the_lab_does(views):
    views.go("three-planes")
    start = start_of(*hand(views.lab))
    settings = views.planes.picture.settings
    assert (settings.state, settings.friction) == (start.state, start.friction)


def test_what_rolls_goes_on_with_its_constants(views):
    views.go("roll").explorer.param.update(K_J=4.0)
    views.go("three-planes")
    assert views.planes.by == "constants"
    found = Constants.from_state(views.explorer.scene.top, *_parts(views.planes.picture.settings.state))
    assert found.K_J == pytest.approx(4.0)
    views.go("lab")  # where a hand lets it go
    assert views.lab.tilt == pytest.approx(np.degrees(views.explorer.scene.state.theta))
    assert views.lab.table == "ordinary" and views.lab.toy == TOY


def _parts(state):
    return state.theta, state.theta_dot, state.omega2, state.omega3


def test_the_table_goes_along(views):
    views.lab.ask(table="three")
    assert views.go("three-planes").planes.plane == "compare"
    assert views.start.table("ice") == "three-planes" and views.planes.plane == "smooth"
    assert views.go("lab").lab.table == "ice"
    assert views.start.table("rough") == "roll"
    assert views.go("roll").go("lab").lab.table == "rough"


OWN = next(preset.shape for preset in PRESETS if preset.name == "Free profile")


@pytest.mark.parametrize("shape", [TruncatedSphere(R=0.02, c=0.01, l=0.024, r=0.004, M=0.02),
                                   replace(OWN, density=800.0)])  # fmt: skip
def test_a_body_of_ones_own_goes_along_and_stands_in_a_link(views, shape):
    builder = views.start._builder
    views.room = "roll"
    builder._adopt(shape)
    views.go("lab")
    assert views.lab.toy == shape and views.lab.scene is None
    views.lab.show()
    assert views.lab.scene.a == shape.top.a and not views.lab.scene.messages
    codec = Toy([preset.name for preset in PRESETS])
    assert codec.value(codec.text(shape)) == shape


def test_inertias_that_are_no_bodys_are_a_sphere_of_these(views):
    views.room = "roll"
    views.explorer.param.update(a=0.11)
    views.go("lab")
    found = views.lab.toy.top
    assert found == Top(0.11, 0.399, 0.408)
    state = start_of(*hand(views.lab)).state
    assert (state.vx, state.omega3) == (0.0, pytest.approx(views.explorer.scene.state.omega3))


def test_other_rooms_change_nothing(views):
    before = hand(views.lab), views.explorer.scene
    for room in ("learn", "maps", "lab", "build-a-top", "roll", "learn"):
        views.go(room)
    assert (hand(views.lab), views.explorer.scene) == before
