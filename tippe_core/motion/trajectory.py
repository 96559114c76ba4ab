"""The record that every kind of motion returns."""

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import TopError, checked, finite, numbers, read_only
from ..paper import equations as eq
from ..paper.constants import State
from ..paper.top import Top
from ..types import Array, Bools, Indices

# SUNK (R): so far below the table a point of the body counts as in it; rounding and a coarse rtol sink less.
SUNK = 1e-3
ANGLES = 1024  # for which lowest() looks at a profile at once
ANOTHER_TOUCHES, PASSES_90 = "another part touches", "theta passes 90 degrees"


class Ledger(NamedTuple):
    """The parts of the energy, whose sum is constant: see Trajectory.ledger.

    Attributes
    ----------
    spin, precession, nutation : array (n,)
        I3 w3^2/2, I1 w2^2/2, I1 w1^2/2, in MgR
    height : array (n,)
        of G, relative to upright
    translation : array (n,)
        v^2/2 of G
    heat : array (n,)
        what is lost
    """

    spin: Array
    precession: Array
    nutation: Array
    height: Array
    translation: Array
    heat: Array

    @property
    def kinetic(self) -> Array:
        """The kinetic energy, (n,)."""
        return self.spin + self.precession + self.nutation + self.translation


@dataclass(frozen=True, eq=False)
class Trajectory:
    """A motion of a top at n instants, in units of R, M and g. All arrays are read-only.

    len() is n; a slice, or an array of bool or of indices, gives the Trajectory of these instants; at(t) is the State
    at one time.

    Attributes
    ----------
    t : array (n,)
        the times, (R/g)^1/2
    theta, phi, psi : array (n,)
        Euler angles in rad, phi the azimuth of 1', continuous in time except for the half turns at a pole
    quaternion : array (n, 4)
        x, y, z, w, from body to space, = Rz(phi) Rx(theta) Rz(psi)
    contact, com : array (n, 2), (n, 3)
        the contact point and G in space, R, with z upwards from the table
    omega : array (n, 3)
        about 1', 2', 3, (g/R)^1/2
    slip : array (n, 2)
        the velocity, (gR)^1/2, of the point of the top that touches the table, in the rotating axes x (along 1'), y
        (z cross 1')
    force : array (n, 3)
        the force on the top there, Mg, in the axes x, y, z
    regime : array of str (n,)
        "roll", "slip" or "air"
    events : tuple of (time, name)
        what changed the motion
    velocity : array (n, 3)
        of G, in the same axes; by default omega x r + slip, for contact at the sphere
    heat : array (n,)
        the energy lost since t[0] by friction, rolling resistance, air drag and impacts, MgR, integrated along with
        the motion; 0 by default
    supports : tuple of (time, name)
        what carries the top from that time on, "ball", "stem", "both" or "none": the first at t[0], the others at
        each change, located like events; by default the ball alone
    notes : tuple of (time, name)
        what changes nothing: "theta passes 90 degrees", "the stem touches first"
    time_90 : float
        the time of the first "theta passes 90 degrees", nan if there is none

    Notes
    -----
    If the stem touches, contact, slip and force are those of the loaded contact. If both are loaded, the force is the
    sum, and contact and slip are means weighted by the normal forces. In the air slip and force are 0, and contact is
    the point of the table below O.

    trace (n, 3), jellett, routh, energy, L_3, L_z (n,) and ledger are computed from the arrays above, not from the
    initial values.
    """

    top: Top
    t: Array
    theta: Array
    phi: Array
    psi: Array
    quaternion: Array
    contact: Array
    com: Array
    omega: Array
    slip: Array
    force: Array
    regime: NDArray[np.str_]
    events: tuple[tuple[float, str], ...] = ()
    velocity: Array = None  # type: ignore[assignment]  # never None after __post_init__, nor is heat
    heat: Array = None  # type: ignore[assignment]
    supports: tuple[tuple[float, str], ...] = ()
    notes: tuple[tuple[float, str], ...] = ()

    def __post_init__(self) -> None:
        if self.velocity is None:
            (w1, w2, w3), (ux, uy), top = self.omega.T, self.slip.T, self.top
            s, c = np.sin(self.theta), np.cos(self.theta)
            x, y = eq.rolling_velocity(c, s, w1, w2, w3, top)
            object.__setattr__(self, "velocity", np.stack([x + ux, y + uy, top.a * s * w1], axis=1))
        if self.heat is None:
            object.__setattr__(self, "heat", np.zeros(len(self.t)))
        if not self.supports and len(self.t):
            object.__setattr__(self, "supports", ((float(self.t[0]), "ball"),))
        read_only(*vars(self).values())

    def __len__(self) -> int:
        return len(self.t)

    def __getitem__(self, rows: slice | Bools | Indices) -> Self:
        """The Trajectory of some of its instants, in order: a slice, an array of bool, or of indices. events and
        supports up to the last of them are kept."""
        if not isinstance(rows, slice) and np.ndim(rows) != 1:
            raise TopError("rows", rows, "Array(n)", code="wrong-kind")
        arrays: dict[str, Any] = {field.name: value[rows] for field in fields(self)
                                  if isinstance(value := getattr(self, field.name), np.ndarray)}  # fmt: skip
        if not len(arrays["t"]):
            raise TopError("rows", rows, "rows with at least one instant", code="no-rows")
        latest = arrays["t"].max()
        last = np.inf if latest == self.t.max() else latest
        events, supports, notes = (tuple(x for x in each if x[0] <= last)
                                   for each in (self.events, self.supports, self.notes))  # fmt: skip
        return replace(self, events=events, supports=supports, notes=notes, **arrays)

    def until(self, count: int, time: float, event: str) -> Self:
        """The first part of it, which then ends with an event.

        Parameters
        ----------
        count : int
            number of instants that it keeps
        time : float
            of the event, (R/g)^1/2
        event : str
            what happens there

        Returns
        -------
        Trajectory
            without the later events, supports and notes
        """
        events, supports, notes = (tuple(x for x in each if x[0] < time)
                                   for each in (self.events, self.supports, self.notes))  # fmt: skip
        return replace(self[:count], events=(*events, (time, event)), supports=supports or self.supports[:1],
                       notes=notes)  # fmt: skip

    def at(self, t: float) -> State:
        """The State at one time: linear between the two nearest instants, whose angles must not differ by a turn.

        Between two of them theta can pass 0 or pi, where phi and psi change by pi at once; then only denser times help.

        Parameters
        ----------
        t : float
            within its times, (R/g)^1/2

        Returns
        -------
        State
            x, y are those of G; z and vz too while nothing carries it

        Raises
        ------
        TopError
            if t is outside its times
        """
        t = finite("t", t)
        in_time = np.argsort(self.t, kind="stable")
        times = self.t[in_time]
        if not times[0] <= t <= times[-1]:
            raise TopError("t", t, "{first:.10g} to {last:.10g}", code="outside-times", first=float(times[0]),
                           last=float(times[-1]))  # fmt: skip
        columns = np.column_stack([self.theta, self.omega, self.phi, self.psi, self.com, self.velocity])
        theta, w1, w2, w3, phi, psi, x, y, z, vx, vy, vz = (
            float(np.interp(t, times, each)) for each in columns[in_time].T
        )
        on = [name for since, name in self.supports if since <= t or since == self.supports[0][0]][-1]
        flight = {"z": z, "vz": vz} if on == "none" else {}
        return State(theta, w1, 0.0 if theta in (0.0, np.pi) else w2, w3, phi, psi, x, y, vx, vy, **flight)

    @property
    def time_90(self) -> float:
        """When theta first passes 90 degrees; nan if it never does."""
        return next((t for t, name in self.notes if name == PASSES_90), np.nan)

    @cached_property
    def trace(self) -> Array:
        """R^T (contact - G) - a 3, R of the quaternion: the contact in the body's axes, from O, (n, 3).

        The mark that carbon paper on the table would leave on the body; on the ball it has length 1.
        """
        q, w = self.quaternion[:, :3], self.quaternion[:, 3:]
        arm = np.column_stack([self.contact, np.zeros(len(self.t))]) - self.com
        return arm + 2 * np.cross(q, np.cross(q, arm) - w * arm) - (0, 0, self.top.a)

    @cached_property
    def jellett(self) -> Array:
        """C_J = I1 s w2 + I3 (c - a) w3, (14), (n,); the paper's K_J of (30) is C_J/I1."""
        (_, w2, w3) = self.omega.T
        return eq.C_J(np.cos(self.theta), np.sin(self.theta), w2, w3, self.top)

    @cached_property
    def routh(self) -> Array:
        """K_R = f3 w3, (31), (n,)."""
        return eq.K_R(np.cos(self.theta), np.sin(self.theta) ** 2, self.omega[:, 2], self.top)

    @cached_property
    def L_3(self) -> Array:
        """L_3 = I3 w3, the component of the angular momentum about G along axis 3, (n,)."""
        return self.top.I3 * self.omega[:, 2]

    @cached_property
    def L_z(self) -> Array:
        """L_z = I1 s w2 + I3 c w3, the vertical component of the angular momentum about G, (n,)."""
        (_, w2, w3) = self.omega.T
        return eq.L_z(np.cos(self.theta), np.sin(self.theta), w2, w3, self.top)

    @cached_property
    def ledger(self) -> Ledger:
        """The parts of the energy: a Ledger of (n,) arrays in MgR, whose sum is constant.

        spin I3 w3^2/2, precession I1 w2^2/2, nutation I1 w1^2/2, height (of G, relative to upright), translation v^2/2
        of G, including the vertical motion, and heat.
        """
        top, (w1, w2, w3) = self.top, self.omega.T
        height = self.com[:, 2] - (1 - top.a)
        return Ledger(top.I3 * w3**2 / 2, top.I1 * w2**2 / 2, top.I1 * w1**2 / 2, height,
                      (self.velocity**2).sum(axis=1) / 2, self.heat)  # fmt: skip

    @cached_property
    def energy(self) -> Array:
        """E of (6), with the potential energy 0 when upright, (n,)."""
        return sum(self.ledger[:-1], np.zeros(len(self.t)))


def checked_times(times: ArrayLike, forward: bool = False) -> Array:
    """times as a new (n,) float array, or a TopError; forward: they must not decrease."""
    t = numbers("times", times)
    if t.ndim != 1 or not t.size:
        raise TopError("times", times, "a one-dimensional, not empty array of finite numbers, in (R/g)^1/2",
                       code="no-times")  # fmt: skip
    if forward and np.any(np.diff(t) < 0):
        raise TopError("times", times, "times[i] <= times[i + 1]", "None is less than the one before.", code="falling")
    return t


# ---- parts of a body other than its ball and the edge of its stem, which a motion does not know, below the table ----


@checked
def lowest(profile: Array, theta: Array) -> Array:
    """Height above O of the lowest point of a body at the tilts theta.

    Parameters
    ----------
    profile : array (k, 2)
        radius and height above O in R, Shape.profile(n) / Shape.R
    theta : array (n,)
        tilts in rad

    Returns
    -------
    array (n,)
        in R
    """
    radius, z = profile.T[:, :, None]
    parts = np.array_split(theta, len(theta) // ANGLES + 1)  # so that a long motion needs no more memory
    return np.concatenate([(z * np.cos(part) - radius * np.sin(part)).min(axis=0) for part in parts])


def sunk(trajectory: Trajectory, profile: Array) -> int:
    """The first row at which some part of the body is below the table; the number of rows if there is none.

    The contacts of slide() are the sphere and one edge, so another corner of the body may sink into the table, unless
    slide() has the profile. profile as in lowest().
    """
    height = trajectory.com[:, 2] + trajectory.top.a * np.cos(trajectory.theta) + lowest(profile, trajectory.theta)
    return int(np.argmax(np.append(height < -SUNK, True)))
