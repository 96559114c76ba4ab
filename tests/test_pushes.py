"""A push of a top on its way: the run goes on from the State after it, on each table; its story, its link."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from doubles import lab_of
from scipy.spatial.transform import Rotation

from app.model.explorer import Explorer
from app.model.keeps import KINDS, keeps
from app.model.lab.lab import scene_of
from app.model.life import life_of
from app.model.pushes import state_after
from app.model.run import computed, motion_on, whole_on
from app.model.setup import Push, start_of
from app.model.start import arrives
from app.model.story import story
from app.server.messages import CHANGES
from app.share.saved_runs import Shown, caption, run_csv, run_python
from app.state.codecs import Pushes
from app.state.url_state import explorer_of, kept, read
from app.text import speaking
from tippe_core import grip, roll, slide

TOY = "Leine and Glocker's toy"
START = start_of(TOY, 28.65, 5.73, 0.3)
SOFT = Push(2.31, (0.0, 3.0, 10.0), (0.5, -0.6, 0.2))  # while it stands on its stem
LATER = Push(3.1, (0.0, 0.0, 10.0), (0.0, 1.0, 0.0))
PUSHED = replace(START, pushes=(SOFT, LATER), seconds=8.0)
TEXT = "2.31_0_3_10_.5_-.6_.2~3.1_0_0_10_0_1_0"


def at(push):
    return push.t / START.scales.time


def test_before_a_push_it_is_the_run_without_it_and_after_it_that_of_the_state_after_it():
    """To the last bit: no time at which it is looked at changes a step."""
    moved = computed(PUSHED, "ordinary")[0].moved
    same = {"rtol": 1e-9, "edge": START.edge}
    t = moved.t[moved.t < at(SOFT)]
    alone = slide(START.top, START.state, START.friction, [*t, at(SOFT)], **same)
    for name in ("theta", "omega", "com", "quaternion", "heat"):
        assert np.array_equal(getattr(moved, name)[: len(t)], getattr(alone, name)[:-1])
    state = state_after(START, alone, SOFT, START.friction, START.edge)
    later = moved.t[(moved.t >= at(SOFT)) & (moved.t < at(LATER))]
    on = slide(START.top, state, START.friction, later, **same)
    for name in ("theta", "omega", "com"):
        assert np.array_equal(getattr(moved, name)[len(t) : len(t) + len(later)], getattr(on, name))
    assert np.all(np.diff(moved.t) > 0) and moved.events.count((at(SOFT), "pushed")) == 1


def test_it_goes_on_from_where_somebody_has_looked_before():
    life_of.cache_clear()
    life = life_of(PUSHED)
    life.until(2.0)
    found = life.until(6.0).moved
    life_of.cache_clear()
    once = life_of(PUSHED).until(6.0).moved
    assert np.array_equal(found.t, once.t) and np.array_equal(found.theta, once.theta)


@pytest.mark.parametrize("table", ["ordinary", "rough", "ice"])
def test_the_energy_rises_by_no_more_than_the_work_and_is_kept_or_rubbed_away_after_it(table):
    """The work of an impulse is at most that on the point as it moves without the table: F (v + K F/2),
    K <= 1 + r^2/I."""
    motion = motion_on(table, PUSHED)
    moved, unit = motion.trajectory, START.scales
    whole = moved.energy + moved.heat
    rows = [0, *(row for _, row, _ in motion.pushes), len(moved)]
    for first, last in pairwise(rows):
        assert np.ptp(whole[first:last]) < 2e-6 * np.abs(whole).max()
    for push, row, gain in motion.pushes:
        F, r = push.size / START.impulse, np.linalg.norm(push.point) / (1e3 * unit.R) + abs(START.top.a)
        speed = np.linalg.norm(moved.velocity[row - 1]) + r * np.linalg.norm(moved.omega[row - 1])
        assert gain == pytest.approx(whole[row] - whole[row - 1])
        assert gain <= F * speed + F**2 / 2 * (1 + r**2 / min(START.top.I1, START.top.I3))
    assert len(motion.pushes) == 2


@pytest.mark.parametrize("table", ["ordinary", "rough", "ice"])
def test_an_upright_top_goes_where_it_is_pushed(table):
    """Along x of the table, however far it has turned."""
    asleep = start_of(TOY, 28.65, 0.0, 0.3)
    motion = motion_on(table, replace(asleep, pushes=(Push(1.0, (0.0, 0.0, 10.0), (0.5, 0.0, 0.0)),)))
    [(_, row, _)] = motion.pushes
    x, y = np.diff(motion.trajectory.com[row : row + 2, :2], axis=0)[0]
    assert x > 0 and abs(y) < 0.2 * x


@pytest.mark.parametrize("up", [-0.3, 0.2, 1.0])
def test_the_rough_table_grips_it_again_and_gives_no_torque_about_the_point_that_touches(up):
    push = SOFT._replace(impulse=(0.5, -0.6, up))  # also one that would lift it off
    motion = motion_on("rough", replace(PUSHED, pushes=(push,)))
    moved, [(_, row, _)] = motion.trajectory, motion.pushes
    before = roll(START.top, None, [0.0, at(push)], grip(START.top, START.state)[0])
    turned = Rotation.from_euler("ZX", [before.phi[-1], before.theta[-1]])
    about = Rotation.from_euler("Z", before.phi[-1])

    def momentum(found, i):
        inertia = [START.top.I1, START.top.I1, START.top.I3]
        arm = found.com[i] - [*found.contact[i], 0.0]
        return turned.apply(inertia * found.omega[i]) + np.cross(arm, about.apply(found.velocity[i].copy()))

    R, lowest = 1e3 * START.scales.R, np.array([0.0, 0.0, -1.0])  # of the ball, from O
    given = np.cross(turned.apply(push.point) / R - lowest, about.apply(push.impulse) / START.impulse)
    assert momentum(moved, row) == pytest.approx(momentum(before, -1) + given, abs=1e-9)
    assert set(moved.regime) == {"roll"} and moved.theta[row] == pytest.approx(before.theta[-1], abs=1e-12)


@pytest.mark.parametrize("table", ["ordinary", "ice"])
def test_a_push_that_lifts_it_lets_it_fly(table):
    lifted = replace(PUSHED, pushes=(Push(2.3, (0.0, 0.0, 0.0), (0.0, 0.0, 2.0)), LATER))
    motion = motion_on(table, lifted)
    [(_, row, _), later] = motion.pushes
    moved = motion.trajectory
    assert motion.carried[row] == "none" and later[0] == LATER
    speed = 2.0 / START.impulse + moved.velocity[row - 1, 2]  # nothing but the push
    assert moved.velocity[row, 2] == pytest.approx(speed, abs=0.02)
    t = moved.t[row : row + 5] - moved.t[row]
    assert moved.com[row : row + 5, 2] - moved.com[row, 2] == pytest.approx(
        moved.velocity[row, 2] * t - t**2 / 2, abs=1e-9
    )


def test_what_each_keeps_counts_from_the_last_push():
    motion = motion_on("rough", PUSHED)
    rows, (push, i, _) = keeps(motion), motion.pushes[-1]
    energy, since = rows[:, 1:4], rows[:, 0] >= push.t - 1e-9
    assert set(energy[since, 0]) == {KINDS.index("kept")}
    height = 1e3 * START.scales.R * (motion.trajectory.ledger.kinetic + motion.trajectory.com[:, 2])
    assert np.all(energy[since, 1] == pytest.approx(height[i])) and abs(energy[0, 1] - energy[-1, 1]) > 1


@pytest.mark.parametrize("table", ["ordinary", "rough", "ice"])
def test_the_python_that_is_saved_computes_it_from_the_last_push_on(table, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    motion, found = motion_on(table, replace(PUSHED, pushes=(SOFT, LATER), seconds=3.6)), {}
    shown = Shown(table, motion.trajectory, motion.start)
    exec(run_python(shown), found)
    row = motion.pushes[-1][1]
    t, theta = motion.trajectory.t[row:], motion.trajectory.theta[row:]
    again = np.interp(t, found["motion"].t, found["motion"].theta)
    assert found["motion"].t[0] == t[0] and again == pytest.approx(theta, abs=2e-3)  # between the rows
    assert "2 pushes, the last of 1 mN s at 3.10 s" in caption(shown)[1]
    assert b"push 2 = 1 mN s at 3.1 s" in run_csv(shown)


def test_the_story_tells_it_in_both_languages_and_names_no_other_cause():
    motion = whole_on("ordinary", replace(PUSHED, pushes=(Push(2.31, (0.0, 0.0, 10.0), (0.5, -3.0, 0.0)),)))
    told = story(motion)
    assert [(event.t, event.word) for event in told.events if event.code == "push"] == [(2.31, "pushed")]
    since = [stage for stage in told.stages if 2.31 <= stage.t < 3.0]
    assert all(stage.why.startswith("You pushed it at 2.31 s: 3.04 mN s. That gave it 30 mm") for stage in since)
    assert any(stage.headline == "It falls." for stage in since) and "Rubbing also" not in str(told.stages)
    with speaking("de"):
        assert any("Nach 2,31 s angestoßen: 3,04 mN s." in stage.why for stage in story(motion).stages)
    all_three = scene_of("three", replace(PUSHED, pushes=(SOFT,)))
    assert "The same push went to all of them at 2.31 s: 0.806 mN s." in all_three.wording[1]
    assert all(motion and len(motion.pushes) == 1 for motion in all_three.motions.values())


def test_a_link_holds_it_and_undo_takes_it_away():
    explorer = explorer_of(read(f"?v=4&push={TEXT}")[0])[0]
    assert explorer.pushes == (SOFT, LATER) == explorer.setup.pushes
    keep = kept(explorer)
    assert keep.query == f"?v=4&push={TEXT}"
    keep.commit()
    explorer.set(pushes=())
    keep.commit()
    keep.undo()
    assert explorer.pushes == (SOFT, LATER)
    explorer.set(solve=False, table="ice")
    assert explorer.pushes  # it is the same motion on another table
    explorer.set(solve=False, mu=0.4)
    assert explorer.pushes == ()  # of another motion
    keep.commit()
    keep.undo()
    assert (explorer.mu, explorer.pushes) == (0.3, (SOFT, LATER))


@pytest.mark.parametrize("text", ["1_2", "0_0_0_1_0_0_1", "3_0_0_1_0_0_1~2_0_0_1_0_0_1", "61_0_0_1_0_0_1",
                                  "2_0_0_1_0_0_1e9", "2_0_0_nan_0_0_1", "~",
                                  "~".join(13 * ["1_0_0_0_0_0_1"])])  # fmt: skip
def test_a_link_with_something_else_leaves_it_out(text):
    explorer, sentence = explorer_of({"push": text})
    assert explorer.pushes == () and sentence
    with pytest.raises(ValueError):
        Pushes.value(text)


def test_what_a_browser_may_send_of_them_is_bounded():
    allowed = CHANGES["LabView"]["request"]
    assert allowed.fits([1, "pushes", TEXT], None)
    assert not allowed.fits([1, "pushes", "1" * (Pushes.LONGEST + 1)], None)
    assert not allowed.fits([1, "spin", TEXT * 8], None)


@pytest.mark.parametrize(("push", "says"), [
    (Push(2.0, (0.0, 0.0, 5.0), (9.0, 0.0, 0.0)), "up to 4.6 mN s; 9 mN s are too many"),
    (Push(0.1, (0.0, 0.0, -16.0), (0.1, 0.0, 0.0)), "from below the table"),
    (Push(2.0, (0.0, 0.0, -60.0), (0.1, 0.0, 0.0)), "60 mm from the middle of the ball, and the top reaches"),
])  # fmt: skip
def test_a_push_that_cannot_be_says_what_is_possible_and_all_else_stays(push, says):
    lab = lab_of(Explorer(**arrives()))
    lab.ask(pushes=(LATER,))
    scene = lab.scene
    assert scene.start.pushes == (LATER,)
    lab.ask(pushes=(push,))
    assert says in lab.scene.messages["pushes"] and lab.explorer.pushes == (LATER,)
    assert lab.scene.motions["ordinary"] is scene.motions["ordinary"]
    lab.ask(pushes=())
    assert not lab.scene.messages and not lab.scene.start.pushes


def test_after_its_end_a_run_cannot_be_pushed():
    lab = lab_of(Explorer(**arrives() | {"table": "rough", "spin": 10.0, "tilt": 100.0}))
    end, late = lab.scene.motions["rough"].ended_at, Push(0.5, (0.0, 0.0, 0.0), (0.5, 0.0, 0.0))
    assert end < late.t
    lab.ask(pushes=(late,))
    assert lab.scene.messages["pushes"].startswith(f"This run goes on up to {end:.2f} s") and not lab.explorer.pushes
