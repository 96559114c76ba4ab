"""Fig. 6 and what follows when a motion leaves its tieline, without a browser."""

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.start import arrives
from app.widgets.plane_card import PlaneCard
from app.widgets.plots import Motion
from tippe_core import Top


@pytest.fixture
def card():
    """A PlaneCard that sends requests to an Explorer, and shows its scenes when nothing is dragged."""
    explorer, slid = Explorer(), []
    card = PlaneCard(Motion(), lambda **inputs: explorer.param.update(**inputs), lambda: slid.append("slips"))
    card.explorer, card.slid = explorer, slid

    def show(scene):
        card.show_selected(scene)
        card.plane.show_plane(scene)
        card.show_path(scene)

    explorer.param.watch(lambda event: show(event.new), "scene")
    show(explorer.scene)
    return card


def test_all_tilts_are_shown_and_the_papers_own_by_one_switch(card):
    assert card.plane.figure.x_range.end == np.pi and card.slips.below.x_range is card.plane.figure.x_range
    assert card.plane.figure.min_border_left == card.slips.below.min_border_left
    card.explorer.upper = "paper"
    assert card.plane.figure.x_range.end == pytest.approx(1.03 * 1.6943, abs=1e-3)


def test_the_path_leaves_the_tieline_by_its_end_and_is_that_motions_alone(card):
    own, end = card.slips.own.data, card.slips.end.data
    assert own["theta"][0] == card.explorer.scene.turning[1] and own["K_J"][0] == pytest.approx(7)
    assert end["theta"][0] > np.pi / 2 and end["K_R"][0] < 0 and len(card.slips.beyond.data["theta"])
    assert card.slips.touch.visible and np.degrees(card.slips.touch.location) == pytest.approx(119, abs=0.5)
    before = card.explorer.scene
    card.show_selected(Explorer(K_J=6.0).scene)
    assert not len(card.slips.own.data["theta"]) and not card.slips.touch.visible
    card.show_path(before)
    assert len(card.slips.own.data["theta"])


def test_the_words_of_slipping_stand_in_the_figure_wherever_the_path_ends(card):
    """Left of its end, or right of that, or from the edge on."""
    sides = set()
    for spin in (20.0, 60.0, 150.0):
        card.explorer.param.update(given="hand", spin=spin, tilt=5.7)
        for word in (card.slips.words["keeps"], card.slips.words["goes"]):
            at = word.x / card.plane.figure.x_range.end
            wide = 5.5 / 300 * max(map(len, word.text.split("\n")))  # px of a letter, and of the figure on a phone
            assert word.visible
            assert (at >= wide) if word.text_align == "right" else (at == 0 or at + wide < 1)
            sides.add(word.text_align)
    assert sides == {"left", "right"}


def test_where_it_would_slip_there_is_a_road(card):
    assert not card.slip.visible
    card.explorer.energy = 1.5
    assert card.slip.visible
    card.slip.clicks += 1
    assert card.slid == ["slips"]


def test_a_toy_that_was_gripped_is_shown_from_near_and_one_press_shows_the_papers_top(card):
    assert not card.near.view.visible and not card.paper.visible
    card.explorer.param.update(**arrives())
    inner, outer = np.degrees(card.explorer.scene.turning)
    assert (inner, outer) == pytest.approx((1.2, 5.7), abs=0.05)
    assert card.near.view.visible and card.paper.visible
    assert card.near.figure.x_range.start < np.radians(inner) < np.radians(outer) < card.near.figure.x_range.end
    card.paper.clicks += 1
    assert card.explorer.scene.top == Top.paper() and card.explorer.scene.constants.K_J == 7
    assert not card.near.view.visible and not card.paper.visible
