"""Where friction takes a top: the steady states at a given Jellett constant, and the spins at which their stability
changes.

Friction at a point contact, without a pivoting torque and without other losses, conserves C_J = I1 s w2 + I3 (c - a) w3
and only dissipates energy. (With Contensou's law, rolling resistance or air drag, C_J decreases slowly, and what
follows holds only while it has hardly changed.) The least energy at a tilt theta is that of the top with G at rest and
omega along r, the line from the contact point to G, so that it does not slip:

    V_J = a(1 - c) + C_J^2/(2 I_eff),     I_eff = I1 s^2 + I3 (c - a)^2 ,

so the final state is a minimum of V_J (Gallop; note 58 of the paper gives its kinetic part, C_J^2/(2 I_eff)). The
friction law sets only the rate. From dV_J/dc = 0, the steady states between the poles are the zeros of a quartic in c:

    a I_eff^2 = C_J^2 [I1 c - I3 (c - a)] .

At the poles C_J = I3 (1 - a) omega (upright) and -I3 (1 + a) Omega (inverted), and V_J has a minimum there if

    upright    a (1 - a)^2 > omega^2 [I1 - I3 (1 - a)] ,        inverted    a (1 + a)^2 < Omega^2 [I3 (1 + a) - I1]

(Rauch-Wojciechowski, Skoldstam, Glad, Regul. Chaotic Dyn. 10, 333 (2005); Rutstam, arXiv:1306.2470).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from .errors import TopError, checked, checked_many, finite, has_arrays, read_only
from .paper import equations as eq
from .paper.constants import State, require_contact, versines
from .paper.top import Top
from .types import Array, Bools, Like, Number, Scalars


class SteadyStates(NamedTuple):
    """The steady states at a given C_J. Read-only arrays.

    Attributes
    ----------
    theta : array (k,)
        tilts in rad, from 0 to pi
    stable : array of bool (k,)
        True at minima of V_J
    """

    theta: Array
    stable: Bools


@dataclass(frozen=True)
class Change:
    """How the stability of spinning about the vertical axis at a pole depends on the spin.

    Attributes
    ----------
    stable : str
        "above" or "below" the threshold spin, or "always" or "never"
    spin : float
        the threshold in (g/R)^1/2, nan if there is none
    """

    stable: str
    spin: float

    def holds(self, spin: Scalars) -> bool | Bools:
        """Whether it is stable at a spin.

        Parameters
        ----------
        spin : float or array
            of either sign, (g/R)^1/2; broadcasts

        Returns
        -------
        bool or array of bool
            True where it is stable
        """
        there = (np.abs(spin) > self.spin) == np.equal(self.stable, "above")
        found = np.equal(self.stable, "always") | (np.not_equal(self.stable, "never") & there)
        return found if np.ndim(found) else bool(found)


@dataclass(frozen=True)
class Thresholds:
    """The spins at which upright (theta = 0) and inverted (theta = pi) spinning become stable or unstable.

    Attributes
    ----------
    group : str
        for a >= 0, by I1/I3: "never rises" below 1 - a, "can invert" up to 1 + a, "rises part of the way" above;
        for a < 0: "can stand upright" where I1/I3 < 1 - a, "never stands upright" above; "neutral" for a uniform
        ball, for which all tilts are equivalent
    upright, inverted : Change
        the threshold of omega_3 at that pole
    launch : float
        the upright spin with the same C_J as the inverted threshold, (g/R)^1/2 (nan if there is none)
    rise : float
        for a top that rises part of the way, the largest tilt it can reach at any spin, rad: cos = -a/(I1/I3 - 1)
        (nan for the others)
    """

    group: str
    upright: Change
    inverted: Change
    launch: float
    rise: float


@checked_many
def thresholds(top: Top) -> Thresholds:
    """The spins at which the stability of spinning upright and inverted changes.

    Parameters
    ----------
    top : Top
        one, or many: then each field has arrays of their shape

    Returns
    -------
    Thresholds
        in (g/R)^1/2

    Raises
    ------
    TopError
        for the first top that is not possible
    """
    if has_arrays(top):
        fields = np.broadcast_arrays(top.a, top.I1, top.I3)
        each = [
            thresholds(Top(*numbers)) for numbers in zip(*(field.ravel().tolist() for field in fields), strict=True)
        ]

        def gathered(values: Iterable[object]) -> Any:
            return np.array([*values]).reshape(fields[0].shape)

        upright, inverted = (
            Change(gathered(change.stable for change in changes), gathered(change.spin for change in changes))
            for changes in ([one.upright for one in each], [one.inverted for one in each])
        )
        return Thresholds(gathered(one.group for one in each), upright, inverted,
                          gathered(one.launch for one in each), gathered(one.rise for one in each))  # fmt: skip
    a, gamma = top.a, top.I1 / top.I3
    if a == 0 and gamma == 1:
        group = "neutral"
    elif a < 0:
        group = "can stand upright" if gamma < 1 - a else "never stands upright"
    else:
        group = "never rises" if gamma < 1 - a else "can invert" if gamma < 1 + a else "rises part of the way"
    upright = _change(a * (1 - a) ** 2, top.I3 * (1 - a) - top.I1)
    inverted = _change(-a * (1 + a) ** 2, top.I3 * (1 + a) - top.I1)
    rise = np.arccos(-a / (gamma - 1)) if group == "rises part of the way" else np.nan
    return Thresholds(group, upright, inverted, abs(1 + a) / (1 - a) * inverted.spin, float(rise))


def _change(height: float, inertia: float) -> Change:
    """The Change of a state that is stable if height + inertia spin^2 > 0."""
    if height * inertia < 0:
        return Change("above" if inertia > 0 else "below", float(np.sqrt(-height / inertia)))
    return Change("always" if height + inertia > 0 else "never", np.nan)


@checked_many
def jellett_potential(theta: Like, top: Top, C_J: Scalars) -> Like:
    """V_J = a(1 - c) + C_J^2/(2 I_eff).

    Parameters
    ----------
    theta : float or array
        tilt in rad; broadcasts
    top : Top
        the top
    C_J : float or array
        Jellett's constant, in M (gR^3)^1/2; broadcasts

    Returns
    -------
    float or array
        in MgR; inf where I_eff = 0 but C_J is not
    """
    v, m = versines(theta)
    I_eff = eq.I_eff(1 - v, v * m, top)
    with np.errstate(divide="ignore", invalid="ignore"):
        kinetic: Number = np.where(np.equal(C_J, 0), 0.0, np.square(C_J) / (2 * I_eff))
    return top.a * v + kinetic


@checked
def steady_states(top: Top, C_J: float) -> SteadyStates:
    """The steady states at C_J: the extrema of V_J from theta = 0 to pi, both poles included.

    In each the top precesses steadily without slipping. For any friction law at a point contact, without other losses,
    the minima of V_J are stable. (For a uniform ball V_J is flat: every tilt is steady and none is stable; only the
    poles are listed.)

    Parameters
    ----------
    top : Top
        the top
    C_J : float
        Jellett's constant (14), in M (gR^3)^1/2

    Returns
    -------
    SteadyStates
        theta in rad, and which are stable

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    C_J = finite("C_J", C_J)
    if abs(C_J) > 1e50:
        raise TopError("C_J", C_J, "at most {most:g} in size", code="too-large", most=1e50)
    cosine = np.poly1d([1.0, 0.0])
    I_eff = eq.I_eff(cosine, 1 - cosine**2, top)
    slope = -(C_J**2) / 2 * I_eff.deriv() - top.a * I_eff**2  # I_eff^2 dV_J/dc
    c = [x.real for x in slope.roots if abs(x.imag) < 1e-9 and abs(x.real) < 1]
    places = np.array([1.0, *sorted(c, reverse=True), -1.0])
    between = slope((places[:-1] + places[1:]) / 2)  # > 0 where V_J falls as theta grows
    falls_before = np.array([any(between), *(between > 0)])
    rises_after = np.array([*(between < 0), any(between)])
    found = SteadyStates(np.arccos(places), falls_before & rises_after)
    read_only(*found)
    return found


@dataclass(frozen=True, eq=False)
class Outcome:
    """The final state to which friction at a point contact takes a top, while only its ball touches and C_J is
    conserved.

    C_J changes when a second contact, the stem, touches; a pivoting torque (Contensou's law), rolling resistance and
    air drag change it slowly.

    Attributes
    ----------
    verdict : str
        "turns over", "stays inverted" or, for a < 0, "falls over" (theta = pi); "goes upright" (0); "hangs" in between;
        "stays as it is" (a uniform ball, or a start exactly in a steady state, even an unstable one)
    nudged : str
        if that state is unstable, the verdict after an arbitrarily small disturbance; else ""
    theta, omega3 : float
        the final tilt, rad, and the spin about axis 3 there, (g/R)^1/2
    certain : bool
        True if this is the only minimum of V_J that can be reached with this energy and C_J; False if there are others,
        and this one is downhill from the start
    C_J, launch : float
        the Jellett constant, and the spin of an upright top with the same C_J, (g/R)^1/2
    steady : SteadyStates
        those at C_J
    thresholds : Thresholds
        those of the top
    """

    verdict: str
    nudged: str
    theta: float
    omega3: float
    certain: bool
    C_J: float
    launch: float
    steady: SteadyStates
    thresholds: Thresholds


@checked
def outcome(top: Top, state: State) -> Outcome:
    """Where sliding friction at a point, without other losses, takes a top while only its sphere touches.

    Parameters
    ----------
    top : Top
        the top
    state : State
        the start; vx, vy None mean that G is at rest

    Returns
    -------
    Outcome
        the verdict with its numbers

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    require_contact(top, state)
    s, c, w1, w2, w3 = np.sin(state.theta), np.cos(state.theta), state.theta_dot, state.omega2, state.omega3
    C_J = eq.C_J(c, s, w2, w3, top)
    velocity_2 = (state.vx or 0.0) ** 2 + (state.vy or 0.0) ** 2 + (top.a * s * w1) ** 2
    E = eq.energy(w1, w2, w3, velocity_2, versines(state.theta)[0], top)
    steady, limits = steady_states(top, C_J), thresholds(top)
    V = jellett_potential(steady.theta, top, C_J)
    here = float(jellett_potential(state.theta, top, C_J))
    nudged = ""
    if limits.group == "neutral":
        verdict, theta, certain = "stays as it is", state.theta, True
    else:
        end = _downhill(state.theta, steady, V, here)
        theta, certain = float(steady.theta[end]), _reachable_minima(state.theta, steady, V, E) <= 1
        far = "falls over" if top.a < 0 else "stays inverted" if state.theta > np.pi / 2 else "turns over"
        verdict = "goes upright" if end == 0 else far if end == len(V) - 1 else "hangs"
        if _balances(state.theta, steady, V, E):
            verdict, nudged = "stays as it is", verdict
    launch = C_J / eq.C_J(1.0, 0.0, 0.0, 1.0, top)
    theta = state.theta if nudged else theta
    I_eff = eq.I_eff(np.cos(theta), np.sin(theta) ** 2, top)
    omega3 = C_J * (np.cos(theta) - top.a) / I_eff if I_eff else 0.0
    return Outcome(verdict, nudged, theta, float(omega3), certain, float(C_J), float(launch), steady, limits)


def _balances(theta: float, steady: SteadyStates, V: Array, E: float) -> bool:
    """Whether it starts in an unstable steady state with no energy to spare: exactly at a pole or, in between, to the
    accuracy of the zeros of the polynomial."""
    at = int(np.argmin(np.abs(steady.theta - theta)))
    near = 0.0 if at in (0, len(V) - 1) else 1e-7
    return bool(not steady.stable[at] and abs(steady.theta[at] - theta) <= near and E - V[at] <= 1e-12 * (1 + abs(E)))


def _reachable_minima(theta: float, steady: SteadyStates, V: Array, E: float) -> int:
    """How many minima of V_J can be reached from theta without crossing a barrier higher than E."""
    right = int(np.searchsorted(steady.theta, theta))
    below, count = V <= E, 0
    for side in (range(right - 1, -1, -1), range(right, len(V))):
        for i in side:
            if not below[i]:
                break
            count += bool(steady.stable[i])
    return count


def _downhill(theta: float, steady: SteadyStates, V: Array, here: float) -> int:
    """The index of the minimum of V_J that lies downhill from theta; from a maximum, the lower neighbour."""
    right = int(np.searchsorted(steady.theta, theta))
    at = min(max(right, 0), len(V) - 1)
    if steady.theta[at] == theta:
        if steady.stable[at]:
            return at
        sides = [i for i in (at - 1, at + 1) if 0 <= i < len(V)]
        return min(sides, key=lambda i: V[i])
    # V_J is monotone between neighbours
    end = right if V[right] < here else right - 1
    while not steady.stable[end]:  # a point of inflexion
        end += 1 if end == right else -1
    return end
