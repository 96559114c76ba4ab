"""Share stays open beside the stage, and what it saves is what its link opens."""

import base64
import io
import re
from types import SimpleNamespace

import numpy as np
import pandas as pd
import panel as pn
import pytest
from bokeh.document import Document
from doubles import keeping
from panel.io.state import set_curdoc

import app.widgets.codes
from app.model.lab.lab import Lab
from app.model.runs import Run, Runs
from app.page.page import page
from app.page.session import Session
from app.share.panel import Files, made
from app.share.share import Share
from app.widgets.download import Download
from app.widgets.scheduling import RenderScheduler

# ---- a page whose clock the test has ----


@pytest.fixture
def opened(monkeypatch):
    """opened(query) gives a page with Share open: its session, share, and rest(), after which nothing moves and
    everything is painted."""
    made, timers = {}, []

    for kind in (Session, Share, RenderScheduler):
        monkeypatch.setattr(kind, "__init__", keeping(made, kind.__init__))
    monkeypatch.setattr("app.widgets.rest.REST", 0.0)
    for where in ("app.widgets.scheduling", "app.widgets.rest"):
        monkeypatch.setattr(f"{where}.after", lambda seconds, then: timers.append(then))
    monkeypatch.setattr("app.page.session.Runs", lambda *session: Runs())  # no session: results come at once

    def rest():
        for _ in range(40):
            made[RenderScheduler].painted.painted = made[RenderScheduler].painted.sent
            if timers:
                timers.pop(0)()

    with set_curdoc(Document()):

        def opens(query):
            pn.state.location.search = query
            page()
            made[RenderScheduler]._begun = True
            rest()
            made[Share].toggle()
            return SimpleNamespace(session=made[Session], share=made[Share], rest=rest)

        yield opens


def told(share):
    """(the spin in its link, that of the motion in its figures and its letter, that of the saved run)."""
    in_link = re.search(r"spin=([^&]*)", share._head.link)
    [run] = share._files._shown.values()
    turns = run.setup.state.omega3 * run.setup.scales.angular_velocity / 6.283185307179586
    return float(in_link[1]), share._files._scene.inputs["spin"], pytest.approx(turns)


@pytest.mark.parametrize("tab", ["lab", "three-planes"])
def test_while_it_is_open_it_is_of_the_start_that_its_link_opens(opened, tab):
    seen = opened(f"?v=2&tab={tab}&by=hand&spin=15")
    assert told(seen.share) == (15, 15, 15)
    seen.session.lab_of.ask(spin=12.0)
    seen.rest()
    assert told(seen.share) == (12, 12, 12)
    assert seen.share._files._link == seen.share._head.link
    assert seen.share._files._saves["csv"]._state()[:2] == (seen.share._files._what, seen.share.link)


def test_a_hand_that_moves_has_nothing_solved_for_it_and_nothing_drawn(opened, monkeypatch):
    seen = opened("?v=2&tab=lab")
    codes, solved, explorer = [], [], seen.session.explorer
    real = app.widgets.codes.segno.make
    monkeypatch.setattr(app.widgets.codes.segno, "make", lambda *a, **b: codes.append(a[0]) or real(*a, **b))
    explorer.param.watch(lambda event: solved.append(event.new), "scene")
    for spin in (12.0, 13.0, 14.0):
        seen.session.lab_of.ask(spin=spin)
    assert solved == codes == []
    seen.rest()
    assert len(solved) == 1 and codes == [seen.share.link]
    seen.share.refresh()
    assert len(codes) == 1


def test_a_scene_that_no_link_has_yet_is_not_shown(opened):
    seen = opened("?v=2&tab=roll&KJ=6")
    seen.session.scheduler.ask(K_J=6.5)
    assert "KJ=6" in seen.share._head.link and seen.share._files._scene.constants.K_J == 6
    seen.rest()
    assert "KJ=6.5" in seen.share._head.link and seen.share._files._scene.constants.K_J == 6.5


def test_a_run_is_saved_with_its_own_link_until_the_next_has_come(opened, monkeypatch):
    seen = opened("?v=2&tab=lab&by=hand&spin=15")
    held = []
    runs = seen.session.runs
    monkeypatch.setattr(Runs, "beside", True)
    monkeypatch.setattr(runs, "begin", lambda run, kind, *pool: held.append(run))
    seen.session.lab_of.ask(spin=12.0)
    seen.rest()
    what, link, _ = seen.share._files._saves["csv"]._state()
    assert seen.session.lab_of.busy and "spin=12" in seen.share._head.link
    assert "spin=15" in link and f"{what.setup.state.omega3:.6g}" == f"{15 * _turn(what):.6g}"
    assert len(held) == 1  # solving how this rolls has not started it again
    held[0].done(held[0].result())
    what, link, _ = seen.share._files._saves["csv"]._state()
    assert "spin=12" in link and f"{what.setup.state.omega3:.6g}" == f"{12 * _turn(what):.6g}"


def _turn(what):
    return 6.283185307179586 / what.setup.scales.angular_velocity


def test_a_lab_whose_run_is_under_way_is_not_disturbed_by_how_its_start_rolls(opened):
    lab = opened("?v=2&tab=lab").session.lab_of
    lab.ask(spin=12.0)
    lab.rest()
    assert isinstance(lab, Lab) and lab.rests
    lab.explorer.settle()
    assert lab.rests


# ---- files ----


class Beside(Runs):
    """Does the work when told to, and forgets it like Runs with threads."""

    def __init__(self):
        super().__init__()
        self.begun = []

    def begin(self, run, kind, *pool):
        for before, its_kind in self.begun:
            if its_kind == kind:
                before.forget()
        self.begun.append((run, kind))

    def work(self):
        while self.begun:
            run: Run = self.begun.pop(0)[0]
            run.done(run.result())


def test_of_three_tables_the_files_are_of_the_one_that_is_chosen(opened):
    seen = opened("?v=4&spin=15&table=three")
    files = seen.share._files
    for table in ("ordinary", "rough", "ice"):
        files._table.value = table
        assert f"This motion, {table}" in files._of.object
        assert {save.filename for save in files._saves.values()} == {
            f"tippe-top-{table}.{kind}" for kind in files._saves
        }
        what, link, _ = files._saves["csv"]._state()
        saved = pd.read_csv(io.BytesIO(made("csv", what, link, 1.0)), comment="#")
        run = seen.session.lab_of.scene.motions[table].trajectory
        assert link == files._link and np.array_equal(saved["theta (rad)"], run.theta)


def test_two_buttons_whose_files_have_one_name_answer_both():
    runs = Beside()
    buttons = [Download(runs, tuple, lambda text=text: text, label="PNG", filename="one.png") for text in (b"a", b"b")]
    for button in buttons:
        button.clicks += 1
    runs.work()
    assert [button.making for button in buttons] == [False, False]
    assert [base64.b64decode(button.file[1]) for button in buttons] == [b"a", b"b"]


def test_a_file_is_called_as_what_was_asked_for():
    runs = Beside()
    button = Download(runs, tuple, lambda: b"ordinary", label="CSV", filename="tippe-top-ordinary.csv")
    button.clicks += 1
    button.filename = "tippe-top-ice.csv"
    runs.work()
    assert button.file[2] == "tippe-top-ordinary.csv"


def test_figures_in_python_are_written_anew_for_another_scene_alone(opened, monkeypatch):
    seen, written = opened("?v=2&tab=roll"), []
    monkeypatch.setattr(Files, "_show_python", lambda files: written.append(files._scene))
    seen.share.refresh()
    assert written == []
    seen.session.scheduler.ask(K_J=6.5)
    seen.rest()
    assert [scene.constants.K_J for scene in written] == [6.5]
