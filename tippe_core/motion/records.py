"""The records of numbers and small arrays that the kernels of a motion share. Each is one block of memory, so that
passing it costs nothing, and has named fields in compiled code and in Python alike."""

from typing import Any, TypeAlias

import numpy as np

from .kinds import HALTS, Modes

Record: TypeAlias = Any  # an np.record of one of these types


def kind(**fields: object) -> Any:
    """A record type: each field is a float, an array of the given shape, or of the given type."""
    parts: list[tuple[Any, ...]] = []
    for name, what in fields.items():
        if isinstance(what, tuple):  # a shape, or a type and a shape
            parts.append((name, *what) if isinstance(what[0], str) else (name, float, what))
        else:
            parts.append((name, what))
    return np.dtype((np.record, np.dtype(parts, align=True)))


def new(kind: Any) -> Record:
    """A record of this type, all zeros."""
    return np.zeros(1, kind)[0]


def modes_of(W: Record) -> Modes:
    """The present modes of ball and stem."""
    return W.modes[BALL], W.modes[STEM]


OPEN, SLIP, STICK = range(3)  # modes of a contact
BALL, STEM = range(2)  # the contacts
NO_ONE = -1  # the slowest contact if none slips by Coulomb's law

# A row of a Trajectory, by the names of its fields.
SAMPLE = kind(t=float, theta=float, phi=float, psi=float, quaternion=(4,), contact=(2,), com=(3,), omega=(3,),
              slip=(2,), force=(3,), velocity=(3,), heat=float, regime="i8")  # fmt: skip

# A law of friction, friction.Law.
LAW = kind(kind="i8", mu=float, mu_s=float, width=float, radius=float, pivots="?")

# The constants of one motion. k = 1/I3 - 1/I1; b, h, q: of the stem's edge, if stem is 1; rim: cos(theta) where the
# ball's surface ends, -2 if it does not; delta, drag: of rolling resistance and of the air; tolerance: of a step.
PROBLEM = kind(a=float, I1=float, I3=float, k=float, law=LAW, stem="i8", b=float, h=float, q=float, rim=float,
               delta=float, drag=float, tolerance=float)  # fmt: skip

# An impact, impact.py: (u, w_z) = start + W impulse; its speed; the impulse before a step, at a stage and after it, its
# rates at the stages, the errors allowed.
IMPACT = kind(W=(4, 4), start=(4,), scale=float, J=(4,), K=(13, 4), at=(4,), new=(4,), allowed=(4,))

# The values at one instant. For ball and stem: rho, rho', u, u' without the contact forces, F, M (torques in addition
# to rho x F), heights above the table. (k u_x, k u_y, t) of a contact, and 1 + the contact of which it is known
# beforehand. G: v and z of G. Then v', L', w'; the columns, the force and the torque about G of each unknown; the
# contact, and the component of its u', to which each belongs; the equations for them; an impact.
CONTACTS = kind(rho=(2, 3), rho_dot=(2, 3), u=(2, 3), free=(2, 3), F=(2, 3), M=(2, 3), height=(2,), friction=(3,),
                given="i8", G=(4,), v_dot=(3,), L_dot=(3,), w_dot=(3,), columns=(7, 6), owner=("i8", (7,)),
                part=("i8", (7,)), matrix=(7, 7), right=(7,), impact=IMPACT)  # fmt: skip

# A step of stepper.py: the rates at its stages, z before and after it and at a stage, the scales of z, the coefficients
# of the polynomial; and those of implicit.py: its stages, the Jacobian and the equations for a stage, y there,
# the contact that creeps, the unit of its slip. Of the step that is begun, if one is: its length, the part of it that
# is taken, the time and the event at the end of that part, the normal force at its end, the slowest contact, whether
# tau is the time.
STEP = kind(K=(16, 16), z=(16,), new=(16,), at=(16,), scale=(16,), polynomial=(7, 16),
            U=(8, 16), J=(16, 10), matrix=(10, 10), pivots=("i8", (10,)), right=(10,), y=(16,), creeps="i8", unit=float,
            begun="i8", h=float, share=float, until=float, event=("i8", (2,)), N=float, slowest="i8",
            timed="?")  # fmt: skip

# The summary of a motion, summary.py.
SUMMARY = kind(since=float, C_J=float, drift=float, touched="i8", F_z_least=float, least=float, most=float,
               seen="i8", slips="i8")  # fmt: skip

# An entry of the log of a motion: a time; what happened, by its place in events.EVENTS; and carried() after it.
LOG = kind(t=float, name="i8", supports="i8")

# A motion: y, the modes of ball and stem, the heights that count as the table's (slightly below 0 for contacts that
# have just opened), the angles of poses.py, the next step, the guards; the numbers of samples, of events, of entries of
# the log and of steps; whether a stretch begins, whether the rates at y are in step.K; the slowest contact with its
# log|u| and beta, and whether beta is kept steady; whether the next step is to be implicit, and whether the last one
# was; the contact that creeps in the next one, if that is implicit.
MOTION = kind(y=(16,), modes=("i8", (2,)), floor=(2,), angles=(2,), h=float, guards=(HALTS, 2), samples="i8",
              events="i8", logged="i8", steps="i8", begins="i8", rated="i8", slowest="i8", polar=(2,), steady="i8",
              stiff="i8", implicit="i8", creeps="i8", step=STEP, contacts=CONTACTS, summary=SUMMARY)  # fmt: skip
