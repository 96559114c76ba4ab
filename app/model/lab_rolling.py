"""From the Lab to the paper: the motion that the rough table gives to a start of the Lab, as an Explorer's inputs."""

from app.model.lab_run import Toy, start_of
from tippe_core import grip


def rolling(toy: Toy, spin: float, tilt: float, mu: float) -> dict[str, object]:
    """{input of an Explorer: value} of a toy that is let go by a hand, with this spin (rev/s) and tilt (degrees), and
    gripped."""
    start = start_of(toy, spin, tilt, mu)
    state, _ = grip(start.top, start.state)
    top = start.top
    return {
        "shape": start.shape, "a": top.a, "I1": top.I1, "I3": top.I3, "given": "state", "theta": state.theta,
        "theta_dot": state.theta_dot, "omega2": state.omega2, "omega3": state.omega3, "phi": 0.0, "psi": 0.0,
    }  # fmt: skip
