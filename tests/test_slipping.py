"""What Fig. 6 shows of a motion that starts to slip at the end of its tieline."""

import numpy as np
import pytest

from app.model.roll.slipping import MU, at_the_end, slipping
from app.model.scene import solve
from tippe_core import PRESETS, Constants, LoadedSphere, Top, TruncatedSphere, steady_precessions


@pytest.fixture(scope="module")
def scene():
    """The paper's top at its tieline of K_J = 7, as far as mu_s = 0.5 lets it."""
    return solve(Top.paper(), 7.0, 10.0, 0.5, share=1.0)


def test_the_papers_top_rolls_again_where_a_body_on_compliant_contacts_does(scene):
    """That body, 6.4 s after it was let slip with mu 0.3 and a patch of 0.008 R: 2.69 rad, K_J 6.66, K_R -8.38."""
    path = slipping(scene)
    assert path.rolls and path.mu == MU == 0.3
    assert path.theta[-1] == pytest.approx(2.69, abs=5e-3)
    assert path.K_J[-1] == pytest.approx(6.66, abs=5e-3)
    assert path.K_R[-1] == pytest.approx(-8.38, abs=5e-3)
    assert path.seconds * scene.scales.time == pytest.approx(6.4, abs=0.05)


def test_where_it_rolls_again_it_is_the_steady_precession_of_its_constants(scene):
    path = slipping(scene)
    steady = steady_precessions(scene.top, path.K_J[-1], path.K_R[-1])
    assert np.abs(steady.theta - path.theta[-1]).min() < np.radians(0.1)


def test_it_starts_as_the_rolling_motion_turns(scene):
    path, state = slipping(scene), at_the_end(scene)
    assert (path.theta[0], path.K_J[0], path.K_R[0]) == pytest.approx((scene.turning[1], 7.0, 10.0), rel=1e-12)
    found = Constants.from_state(scene.top, state.theta, state.theta_dot, state.omega2, state.omega3)
    assert (found.K_J, found.K_R, found.E) == pytest.approx((7.0, 10.0, scene.constants.E), rel=1e-12)


def test_K_J_nearly_stays_and_K_R_goes_through_zero(scene):
    path = slipping(scene)
    assert np.ptp(path.K_J) < 0.05 * 7 and path.K_R.min() < 0 < path.K_R.max()
    assert np.all(path.low <= path.theta + 1e-12) and np.all(path.theta <= path.high + 1e-12)


def test_the_stem_touches_where_its_shape_says(scene):
    """At 119 degrees; a sphere without a stem never."""
    path, touch = slipping(scene), TruncatedSphere.paper().touch_angle
    assert path.high[path.touches] > touch >= path.high[: path.touches].max()
    sphere = next(preset.shape for preset in PRESETS if isinstance(preset.shape, LoadedSphere))
    assert slipping(solve(sphere.top, 6.0, 9.0, 0.5, share=1.0, shape=sphere)).touches is None


def test_where_nothing_slips_there_is_no_path():
    assert slipping(solve(Top.paper(), 7.0, 10.0, 0.0, share=0.5)) is None
