"""The lesson for the browser: its steps in words, and the runs that it plays.

After a moment a page has all of it, so that it continues without a network.
"""

from contextlib import suppress

import numpy as np
import param

from app.bundle import Bundled, pack
from app.model.arrival import SPIN, TILT
from app.model.lesson import lesson
from app.model.lesson.parts import Choice
from app.model.lesson.runs import named, nutations, own
from app.model.lesson.six import UNSURE
from app.model.roll.levers import levers
from app.model.run import TableMotion
from app.model.setup import TABLES
from app.model.story import story
from app.state.names import link
from app.text import error_text, listed, say
from app.widgets.spelling import spelled
from app.widgets.top3d import pack_frames
from tippe_core import TopError

SLOW = 8.0  # s in which a nutation is shown, which takes some hundredths of a second
FIRST = "ordinary"


class LessonView(Bundled):
    """The lesson: the steps, the question, the top that answers it, and the figure of the present step.

    A run is {"frames", "profile", "a", "seconds"} as in a Top3D, "curves" as in a LabView, and "arms": float32 rows of
    the points of levers.Levers, for each row of the curves.
    """

    SAYS = ("Stage", "Top3D", "NumberControls")
    REGIMES = "here"

    steps = param.List(default=[], doc="Each step in words; JavaScript inserts the numbers that it computes.")
    runs = param.Dict(default={}, doc="{name: run}, of the lesson.")
    others = param.Dict(default={}, doc="{name: run}, those of theory and of the page's own top.")
    worksheet = param.String(default="", doc="A page to print, in HTML.")
    state = param.Dict(default={}, doc='step: which is looked at; role: "phone" in a class; room: of a class.')
    request = param.List(default=[], doc="[count, name, value] of a request, the browser writes it.")

    @classmethod
    def says(cls, language=None):
        own = listed("learn.view", language) | {"sections": listed("learn.sections", language)}
        own |= {"room": listed("teach.room", language), "open": say("published.page.open", language)}
        drawn = listed("learn.pictures", language)
        return super().says(language) | listed("lab_view.view", language) | {"lesson": own, "drawn": drawn}


def cut(motion, end):
    """A run as it is played, up to `end` (s)."""
    n = int(np.searchsorted(motion.t * motion.start.scales.time, end)) + 2
    rows = motion.curves[: int(np.searchsorted(motion.curves[:, 0], end)) + 2]
    return played(motion.start, [part[:n] for part in motion.frames], rows, levers(motion.trajectory), motion.seconds)


def played(start, frames, rows, arms=None, times=()):
    found = {"frames": pack_frames(*frames), "curves": pack(rows), "profile": pack(start.profile), "a": start.top.a,
             "seconds": start.scales.time, "arms": b""}  # fmt: skip
    if arms is not None:
        at = np.clip(np.searchsorted(times, rows[:, 0] - 1e-6), 0, len(times) - 1)
        found["arms"] = pack(np.column_stack([arms.axis, arms.G, arms.foot])[at])
    return found


def runs_of(steps, scene, hidden=False):
    """{name: run} of some steps; those of the page's own top and of the theory are for this scene. hidden: only up to
    the time before the answer."""
    ends, found = {}, {}
    for step in steps:
        for name in step.tops:
            ends[name] = max(step.before if hidden else step.end, ends.get(name, 0.0))
    for name, end in ends.items():
        with suppress(TopError):  # the step says that there is none
            found[name] = cut(own(scene) if name == "yours" else named(name), end)
    for step in steps:
        if step.inputs:
            with suppress(TopError):
                plan = lesson.planned(step, scene)
                found[step.name] = played(plan, *nutations(plan, step.before if hidden else step.end))
    return found


TELLS = {"told": [], "learned": "", "truth": None, "graph": None, "events": [], "tex": []}


def state_of(step, scene, hidden=False):
    """A step in words and numbers, with its answer unless that is hidden; if it is impossible for this top, the
    sentence that says why."""
    head = {"name": step.name, "title": say(f"learn.{step.name}.title"), "theory": step in lesson.THEORY}
    try:
        plan = lesson.planned(step, scene)
        return head | _answered(step, plan, step.answer(plan)) | (TELLS if hidden else {})
    except TopError as error:
        return head | {"refused": error_text(error), "question": head["title"]}


def _answered(step, plan, answer):
    numbers = answer.numbers | ({"spin": SPIN, "tilt": TILT} if step.name == "yours" else {})
    long = plan.rolling.period * plan.scales.time if step.inputs else 1.0
    motions = {name: _motion(name, plan) for name in step.tops}
    words = {key: spelled(say(f"learn.{step.name}.{key}", **numbers)) for key in ("question", "hint", "learned")}
    return words | {
        "told": spelled(say(f"learn.{step.name}.{answer.told}", **numbers)).split("\n"),
        "asks": asks(step, answer.truth), "truth": truth_of(answer.truth), "later": list(step.later),
        "tops": [[name, say(f"learn.tops.{name}")] for name in step.tops] or [[step.name, say("learn.tops.plan")]],
        "before": step.before * long, "end": step.end * long, "speed": long / SLOW if step.inputs else 0.0,
        "events": _events(motions.get(FIRST if FIRST in motions else next(iter(motions), None))),
        "stages": {name: [[t, short] for t, *_, short in story(motion).stages] for name, motion in motions.items()
                   if not step.later},
        "picture": step.picture, "graph": _graph(answer.picture), "tex": list(step.tex), "refused": "",
        "opens": opened(step.tops),
        "sources": [[name, *listed(f"sources.{name}").values()] for name in step.sources],
    }  # fmt: skip


def opened(tops):
    """The link that opens the runs of a step in the Lab, "" if they are not those of the arrival's toy on its tables: a
    link has the start of the arrival if it says no more."""
    return link(tab="lab", table=tops[0] if len(tops) == 1 else "three") if tops and {*tops} <= {*TABLES} else ""


def _motion(name, plan) -> TableMotion:
    return own(plan) if name == "yours" else named(name)


def _events(motion):
    found = story(motion).events if motion else ()
    stands = any(code == "stands-on-stem" for _, code, *_ in found)
    return [[t, code, spelled(word), spelled(short)] for t, code, word, short in found if code != "stem" or not stands]


def truth_of(truth):
    """The true value for the browser: None if there is no such number."""
    return truth if isinstance(truth, str) else None if np.isnan(truth) else float(truth)


def asks(step, truth=None):
    """The question of a step for the browser: options with their words, or a slider. truth: left out if it is None."""
    if isinstance(step.asks, Choice):
        words = listed(f"learn.{step.name}.options")
        options = [[key, words.get(key) or say("learn.view.unsure_option")] for key in step.asks.options]
        if isinstance(truth, str) and truth not in step.asks.options:
            options.insert(-1, [truth, words[truth]])
        return {"options": options, "unsure": UNSURE}
    guess = step.asks
    found = {"low": guess.low, "high": guess.high, "step": guess.step, "unit": guess.unit}
    return found if truth is None else found | {"near": guess.near(truth)}


def _graph(picture):
    """A Picture for the browser."""
    if picture is None:
        return None
    return {
        "x": say(f"learn.axes.{picture.x}"), "y": say(f"learn.axes.{picture.y}"), "of": picture.x,
        "curves": [{"key": part.key, "word": say(f"learn.curves.{part.key}"), "colour": part.colour, "dash": part.dash,
                    "x": pack(part.x), "y": pack(part.y)} for part in picture.curves],
        "points": [[say(f"learn.points.{part.key}"), float(part.x), float(part.y)] for part in picture.points],
    }  # fmt: skip
