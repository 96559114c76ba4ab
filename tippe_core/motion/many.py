"""Many motions with friction at once, on all cores: the basis of the maps."""

import os
import threading
from collections.abc import Callable, Iterable
from concurrent.futures import Executor, ThreadPoolExecutor, as_completed
from dataclasses import MISSING, dataclass, fields
from typing import Any, NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..classify import LAST, judged
from ..errors import TopError, common_shape, has_arrays, numbers, of_kind, positive, read_only, single
from ..paper.constants import State
from ..paper.top import Top
from ..types import Array, Bools
from . import at, events, preparing
from .dynamics import carried
from .friction import Friction
from .kinds import STARTS, TOUCHES
from .nudge import as_high, beside, checked_nudge
from .periodic import run_all
from .poses import sample_at
from .records import LOG, OPEN, SAMPLE, Record, modes_of, new
from .run import ENDED, MORE
from .summary import begin, energy_at

CELL_EVENTS, CELL_STEPS = 4000, 1_000_000  # in one motion
STEPS_BETWEEN_STOPS = 20_000  # steps between two checks for a stop
CELLS = 16  # motions a thread takes at a time


class States(NamedTuple):
    """Many States, as one array for each field of State.

    Attributes
    ----------
    theta, theta_dot, omega2, omega3, phi, psi, x, y, vx, vy, z, vz : array
        as in State, with its defaults; z, vz nan where a contact carries
    """

    theta: Array
    theta_dot: Array
    omega2: Array
    omega3: Array
    phi: Array = 0.0  # type: ignore[assignment]
    psi: Array = 0.0  # type: ignore[assignment]
    x: Array = None  # type: ignore[assignment]
    y: Array = None  # type: ignore[assignment]
    vx: Array = None  # type: ignore[assignment]
    vy: Array = None  # type: ignore[assignment]
    z: Array = None  # type: ignore[assignment]
    vz: Array = None  # type: ignore[assignment]


@dataclass(frozen=True, eq=False)
class Many:
    """The results of many motions: read-only arrays of the shape to which the arguments broadcast, in units of R, M, g.

    Attributes
    ----------
    theta_end, state_end : array, States
        the final theta (rad), and the final States, in the form that slide_many() accepts: at t_end, or where the
        motion ended earlier
    time_90, time_stem : array
        when theta first passes 90 degrees, when the stem first touches; nan if never
    hops, flew : array of int, of bool
        the number of times it left the table; whether it ever did
    F_z_least : array
        the least F_z while the top was on the table, at the ends of steps, Mg
    heat : array
        the energy lost by friction, rolling resistance, air drag and impacts, MgR
    energy_error : array
        energy and heat at the end, minus the energy at the start, MgR
    C_J_drift : array
        the largest change of C_J until the stem touches, relative to C_J; nan with a pivoting torque (Contensou's
        law), rolling resistance or air drag
    growth : array
        the factor by which a disturbance of the initial theta has grown by the end; nan without nudge
    end : array of str
        judged by the last tenth of the time, in this order: "refused" (no such top, start or friction; Painleve's
        limit; the ball's surface ends; too many events or steps), "stem" (on its stem alone), "upright" (on its
        ball, theta < 0.2), "inverted" (on its ball, theta > pi - 0.2), "leaning" (theta constant within 0.05 rad),
        "rolling" (without slipping, nutating), "moving"
    reason : array of str
        why a motion is "refused": the code of the TopError that slide() raises, "too-strong" or "beyond-rim" also
        of an event, "too-many-events" (after 4,000; slide() allows 10,000), "too-many-steps" (after a million;
        slide() allows four), or "lifts-off" if landing is to stop it there; "" elsewhere
    """

    theta_end: Array
    state_end: States
    time_90: Array
    time_stem: Array
    hops: NDArray[np.int64]
    F_z_least: Array
    flew: Bools
    heat: Array
    energy_error: Array
    C_J_drift: Array
    growth: Array
    end: NDArray[np.str_]
    reason: NDArray[np.str_]


# The result of one motion, in the order of Many, with the State as a row of numbers.
NUMBERS = ("time_90", "time_stem", "F_z_least", "heat", "energy_error", "C_J_drift", "growth")
RESULT = np.dtype([("state", float, len(States._fields)), *((name, float) for name in NUMBERS), ("hops", int),
                   ("end", "U9"), ("reason", "U20")])  # fmt: skip


class _How(NamedTuple):
    """What all motions of one call have in common; stop: an Event that ends them, where threads compute them."""

    rtol: float
    nudge: float | None
    losses: tuple[float, float]
    flies: bool
    stop: threading.Event | None


def slide_many(
    top: Any, state: Any, friction: Any, t_end: ArrayLike, edge: ArrayLike | None = None, rtol: float = 1e-6,
    nudge: float | None = None, rolling_resistance: float = 0.0, air_drag: float = 0.0,
    progress: Callable[[float], object] | None = None, landing: str = "plastic", executor: Executor | None = None,
) -> Many:  # fmt: skip
    """The results of many motions like those of slide(), from 0 to t_end, on all cores.

    All of top, state, friction, t_end and edge broadcast together.

    Parameters
    ----------
    top, state, friction : Top, State, Friction
        Top and State perhaps with arrays as fields; or lists or arrays of them; or any objects that have their
        fields as arrays, such as types.SimpleNamespace(mu=..., radius=...). The fields that tell a law are mu_k
        (and perhaps mu_s), gamma, mu and eps, or mu and radius: it is the one of which most are given
    t_end : float or array
        in (R/g)^1/2
    edge : array (..., 2 or 3) or None
        as in slide()
    rtol : float
        1e-13 to 1e-3
    nudge : float or None
        in rad, as in sensitivity(); each motion is then computed twice
    rolling_resistance, air_drag : float
        as in slide()
    progress : callable or None
        called from time to time with the fraction done; an exception that it raises stops everything and is passed
        on (where threads compute; elsewhere the motions that are under way, CELLS of them each, are still computed)
    landing : str
        as in slide()
    executor : concurrent.futures.Executor or None
        such as a ProcessPoolExecutor; by default threads, one for each core that the process may use. The numbers
        do not depend on it

    Returns
    -------
    Many
        a cell for which slide() would raise a TopError is "refused", and its numbers are nan; reason has the
        error's code

    Raises
    ------
    TopError
        for shapes that do not broadcast, for anything that is no top, state or law, and for a bad rtol, nudge,
        rolling_resistance, air_drag or landing
    """
    if executor is not None and not isinstance(executor, Executor):
        raise TopError("executor", executor, "Executor", code="wrong-kind")
    if progress is not None and not callable(progress):
        raise TopError("progress", progress, "Callable", code="wrong-kind")
    how = _How(preparing.checked_rtol(rtol), None if nudge is None else checked_nudge(nudge),
               preparing.checked_losses(rolling_resistance, air_drag), preparing.flies(landing),
               threading.Event() if executor is None or isinstance(executor, ThreadPoolExecutor) else None)  # fmt: skip
    parts = [_cells("top", top, Top), _cells("state", state, State), _cells("friction", friction, Friction),
             numbers("t_end", t_end), _rims(edge)]  # fmt: skip
    shape = common_shape("t_end", "shapes of top, state, friction, t_end and edge that broadcast", *parts)
    cells = list(zip(*(np.broadcast_to(part, shape).ravel().tolist() for part in parts), strict=True))
    if executor is not None:
        return _many(_all(cells, how, progress, executor).reshape(shape))
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    with ThreadPoolExecutor(cores) as threads:
        return _many(_all(cells, how, progress, threads).reshape(shape))


def _rims(edge: ArrayLike | None) -> NDArray[np.object_]:
    """An array of (radius, height, rounding), or of None."""
    if edge is None:
        return np.array(None, object)
    rows = numbers("edge", edge)
    if rows.ndim == 0 or rows.shape[-1] not in (2, 3):
        raise TopError("edge", edge, "(radius, height, rounding)", code="wrong-kind")
    return _objects(map(tuple, rows.reshape(-1, rows.shape[-1]).tolist()), rows.shape[:-1])


def _objects(items: Iterable[Any], shape: tuple[int, ...]) -> NDArray[np.object_]:
    return np.fromiter(items, object).reshape(shape)


def _cells(name: str, given: Any, kind: Any) -> NDArray[np.object_]:
    """An array of instances of the kind, or kinds, with the code of the TopError in the place of each that is not
    possible."""
    kinds = get_args(kind) or (kind,)
    if isinstance(given, np.ndarray) or (isinstance(given, list | tuple) and not hasattr(given, "_fields")):
        cells = np.array(given, dtype=object)
        for cell in cells.flat:
            of_kind(name, cell, kind)
            single(name, cell)
        return cells
    if isinstance(given, kinds) and not has_arrays(given):
        return _objects([given], ())
    has = {kind: [field.name for field in fields(kind) if getattr(given, field.name, None) is not None]
           for kind in kinds}  # fmt: skip
    missing = {kind: [field.name for field in fields(kind) if field.default is MISSING and field.name not in has[kind]]
               for kind in kinds}  # fmt: skip
    found = sorted((kind for kind in kinds if not missing[kind]), key=lambda kind: len(has[kind]), reverse=True)
    if len(found) > 1 and len(has[found[0]]) == len(has[found[1]]):
        raise TopError(name, ", ".join(sorted({*has[found[0]], *has[found[1]]})),
                       " | ".join(f"{kind.__name__} with {', '.join(has[kind])} alone" for kind in found[:2]),
                       code="wrong-kind")  # fmt: skip
    if not found:
        wanted = " | ".join(f"{kind.__name__} with {', '.join(names)}" for kind, names in missing.items())
        raise TopError(name, type(given).__name__, wanted, code="wrong-kind")
    kind, names = found[0], has[found[0]]
    arrays = {field: numbers(field, getattr(given, field), False, "biuf" if field == "pivots" else "iuf")
              for field in names}  # fmt: skip
    shape = common_shape(name, "fields that broadcast together", *arrays.values())
    columns = (np.broadcast_to(array, shape).ravel().tolist() for array in arrays.values())
    return _objects([_possible(kind, arrays, row) for row in zip(*columns, strict=True)], shape)


def _possible(kind: type, names: Iterable[str], row: tuple[float, ...]) -> Any:
    """An instance of the kind with these fields, or the code of the TopError that it raises."""
    given = {name: value for name, value in zip(names, row, strict=True)
             if not (name in ("z", "vz") and np.isnan(value))}  # fmt: skip
    try:
        return kind(**given)
    except TopError as error:
        return error.code


def _all(cells: list[Any], how: _How, progress: Callable[[float], object] | None, executor: Executor) -> Any:
    """The RESULTs of all cells."""
    jobs = [executor.submit(_some, cells[first : first + CELLS], how) for first in range(0, len(cells), CELLS)]
    done = 0
    try:
        for job in as_completed(jobs):
            done += len(job.result())
            if progress:
                progress(done / len(cells))
        return np.concatenate([np.zeros(0, RESULT), *(job.result() for job in jobs)])
    except BaseException:
        if how.stop:
            how.stop.set()
        for job in jobs:
            job.cancel()
        raise


def _some(cells: list[Any], how: _How) -> Any:
    """The RESULTs of some motions: what each came to, or that it is refused, and why."""
    refused = np.zeros((), RESULT)
    refused["end"] = "refused"
    for name in ("state", *NUMBERS):
        refused[name] = np.nan
    found = np.full(len(cells), refused)
    for n, cell in enumerate(cells):
        try:
            _compute(found[n], cell, how)
        except TopError as error:
            found[n] = refused
            found[n]["reason"] = error.code
    return found


def _compute(row: Any, cell: tuple[Any, ...], how: _How) -> None:
    """Writes the RESULT of one motion into the row."""
    codes = [part for part in cell[:3] if isinstance(part, str)]
    if codes:
        row["reason"] = codes[0]
        return
    top, state, friction, t_end, edge = cell
    positive("t_end", t_end, zero=True)
    preparing.check_balance(top, friction)
    P = preparing.problem(top, friction, preparing.checked_edge(edge), how.losses, how.rtol)
    _run_to_end(row, state, P, t_end, how)
    if how.nudge is not None:
        near = np.zeros((), RESULT)[()]
        _run_to_end(near, as_high(state, beside(state, how.nudge), P), P, t_end, how)
        row["growth"] = abs(near["state"][0] - row["state"][0]) / abs(how.nudge)


def _run_to_end(row: Any, state: State, P: Record, t_end: float, how: _How) -> None:
    y, angles = preparing.beginning(state, 0.0, P)
    W, log, status = preparing.motion(y, angles), np.zeros(2 * CELL_EVENTS, LOG), ENDED
    event, goes_on = preparing.start(W, P, state)
    E = energy_at(W, P) + W.y[at.HEAT]
    begin(W, P, log, (1 - LAST) * t_end)
    if goes_on and event[0] == TOUCHES:
        events.lands(W, log, event)
    if goes_on and not carried(modes_of(W)) and not how.flies and event[0] == STARTS:
        events.logged(W, log, events.LIFTS_OFF, (OPEN, OPEN))
    elif goes_on:
        status = MORE
        while status == MORE and W.steps < CELL_STEPS and not (how.stop and how.stop.is_set()):
            status = run_all(W, P, log, t_end, how.flies, STEPS_BETWEEN_STOPS)
    T, entries, here = W.summary, log[: W.logged], new(SAMPLE)
    last = entries["name"][-1] if status == ENDED and len(entries) else -1
    reason = ("too-strong" if not goes_on else "too-many-steps" if status == MORE
              else events.REASONS.get(last, "") if np.all(np.isfinite(W.y)) else "not-followed")  # fmt: skip
    on = (
        "stem"
        if last == events.STANDS_UPRIGHT
        else {1 << i: support for i, support in enumerate(events.SUPPORTS)}.get(T.seen, "")
    )
    sample_at(W, P, (OPEN, OPEN), here)
    flight = [np.nan] * 2 if carried(modes_of(W)) else [here.com[2], here.velocity[2]]
    row["state"] = [here.theta, *here.omega, here.phi, here.psi, *here.com[:2], *here.velocity[:2], *flight]
    row["time_90"], row["time_stem"] = (
        events.first(entries, events.PASSES_90),
        events.first(entries, events.FIRST_TOUCH),
    )
    row["F_z_least"] = T.F_z_least if np.isfinite(T.F_z_least) else np.nan
    row["hops"] = np.count_nonzero(entries["name"] == events.LIFTS_OFF)
    row["heat"], row["energy_error"] = W.y[at.HEAT], energy_at(W, P) + W.y[at.HEAT] - E
    if not (P.law.pivots or P.drag > 0 or P.delta > 0):
        row["C_J_drift"] = T.drift / (abs(T.C_J) or 1.0)
    row["end"], row["reason"] = judged(bool(reason), on, T.least, T.most, not T.slips), reason


def _many(found: Any) -> Many:
    """Many, from the RESULTs."""
    parts = {name: np.array(found[name]) for name in (*NUMBERS, "hops", "end", "reason")}
    states = States(*(np.array(part) for part in np.moveaxis(found["state"], -1, 0)))
    read_only(*parts.values(), flew := np.array(parts["hops"] > 0), *states)
    return Many(theta_end=states.theta, state_end=states, flew=flew, **parts)
