"""What a link opens, as a person meets it: words, SI units and numbers of the motion, whatever the page is built of.

The numbers of the motion are tippe_core's for the start, the law and the table that the link opens. They end when it
first lifts off or its stem touches: after an impact a motion may hang on the last digit.
"""

import json
from contextlib import ExitStack, contextmanager
from unittest.mock import patch
from urllib.parse import parse_qs

import numpy as np
import panel as pn
from bokeh.document import Document
from panel.io.state import set_curdoc

from app import text
from app.model.lab.lab import Lab
from app.model.measured import film
from app.model.runs import Runs
from app.model.votes.classroom import Refused, Rooms
from app.page import page
from app.state.names import ROOMS, of
from app.state.url_state import UrlState
from app.tabs.learn.lesson import LessonView
from app.tabs.learn.poll import Counter
from app.tabs.learn.student import Phone
from app.tabs.maps.maps import Maps
from app.tabs.measure.measure import Measure
from app.widgets import rooms
from tippe_core import (
    Contensou,
    Coulomb,
    Rolling,
    SmoothedCoulomb,
    State,
    TopError,
    Viscous,
    glide,
    grip,
    save_top,
    slide,
)

SECONDS = 0.1, 0.25, 0.5, 1.0
"""When it is looked at, s of the real top."""
RTOL = 1e-11
"""Of the sliding motion: with 1e-12 no tilt of the links that are kept changes by more than 2e-8 of itself, and no part
of where the axis leans by more than 5e-8."""
DIGITS = 12
HITS = {"stem touches", "ball touches", "lifts off", "lands", "lands on its stem", "rim touches"}
OF_LAW = {"contact": ("mu", "patch"), "coulomb": ("mu", "mu_s"), "viscous": ("gamma",), "smoothed": ("mu", "eps")}
"""{law: its numbers, by the names of a Start}: the patch in mm, the others without unit or in R, M and g."""
SHOWN = {"track": "show_track", "trace": "show_trace", "path of G": "show_com_path", "force": "show_force",
         "cone": "show_cone", "angular velocity": "show_omega", "angular momentum": "show_momentum",
         "follows": "follow"}  # fmt: skip


class NoStore:
    """A store of votes in which there is no class."""

    def read(self, keys):
        return {}

    def change(self, key, function):
        function(None)


def ask_nobody(counter, work, done):
    """Counter.ask without a server."""
    try:
        done(work(Rooms(NoStore())))
    except Refused as refused:
        done(refused)


@contextmanager
def alone(*kinds):
    """Pages do only these kinds of work, at once and without threads, and there is no class."""

    def begin(runs, run, kind, pool=None):
        if kind in kinds:
            run.done(run.result())

    with patch.object(Runs, "begin", begin), patch.object(Counter, "ask", ask_nobody):
        yield


@contextmanager
def noted(*kinds):
    """A list of the instances of these classes that are made."""
    made = []

    def noting(kind):
        begin = kind.__init__

        def init(self, *rest, **named):
            made.append(self)
            begin(self, *rest, **named)

        return patch.object(kind, "__init__", init)

    with ExitStack() as stack:
        for kind in kinds:
            stack.enter_context(noting(kind))
        yield made


# ---- the two rooms that the Lab had at the level "Research", up to version 3 ----

OLD = {"roll", "three-planes"}


def texts_of(link):
    return {name: text for name, [text, *_] in parse_qs(link.removeprefix("?"), keep_blank_values=True).items()}


def room_of(link):
    """The room that it opened when it was made."""
    texts = texts_of(link)
    is_look = {*texts} <= {"lang", "dark", "large"} and texts.get("lang", "en") in text.LANGUAGES
    version = texts.get("v", "3" if is_look and texts else "1")
    room = texts.get("tab", "lab" if version not in ("1", "2") else "roll")
    return room if room in {*ROOMS, *OLD, "vote"} else "roll"


def is_today(room, rooms):
    """Whether these Rooms show what that room has become."""
    return (rooms.room, rooms.level) == ("lab", "research") if room in OLD else rooms.room == room


def speed_of(link):
    """How fast the top plays, if the link does not say."""
    return 1 / 16 if room_of(link) == "roll" else 0.0


def today(link, what):
    """What a link opens today, from what it opened: a run goes on to its end, and the trace is on the ball."""
    if what.get("room") in OLD:
        what = what | {"room": "lab", "level": "research"}
    if "playing" in what and "slow=" not in link:
        what = what | {"playing": what["playing"] | {"speed": speed_of(link)}}
    if "playing" in what and "trace=no" not in link:
        shown = {*what["playing"]["shows"], "trace"}
        what = what | {"playing": what["playing"] | {"shows": [name for name in SHOWN if name in shown]}}
    if "said" in what:
        what = what | {"said": what["said"].replace("roll, three-planes, ", "")}
    if "run" in what:
        what = what | {"run": {name: value for name, value in what["run"].items() if name != "seconds"}}
    return what


@contextmanager
def kept(link):
    """A list of (UrlState, owner, {parameter: Name}) of all that a page keeps. Of the views only those are made, at
    once, that keep something of this link or may set it back, because the others take most of the time."""
    parts, add, fill = [], UrlState.add, rooms.Place.fill
    keeping = {"lab", "learn", "maps", "measure"}

    def noted(url_state, owner, *rest, **named):
        add(url_state, owner, *rest, **named)
        parts.append((url_state, owner, of(type(owner).__name__)))

    def filled(place):
        if place.column.name.removeprefix("place-of-") in keeping:
            fill(place)

    places = patch.multiple(rooms.Place, fill=filled, ask=filled)
    with patch.object(UrlState, "add", noted), places:
        yield parts


def opens(link):
    """What the link opens, with DIGITS digits."""
    with set_curdoc(Document()), alone("lab"), noted(Lab, Maps, Measure) as views, kept(link) as parts:
        pn.state.location.search = link
        shown = page.page()
        if not parts:
            return of_phone(shown)
        url_state = parts[0][0]
        owners = {type(owner).__name__: owner for _, owner, _ in parts}
        start, room = owners["Explorer"], owners["Rooms"].room
        said = [url_state.sentence, *start.scene.messages.values()]
        said += [said for view in views for said in said_by(view)]
        found = {
            "language": text.spoken(), "room": room, "level": owners["Rooms"].level, "table": start.table,
            "body": json.loads(save_top(start.shape)), "mass": start.scene.scales.M,
            "top": {name: getattr(start, name) for name in ("a", "I1", "I3")},
            "start": start_of(start), "friction": friction_of(start),
            "run": {"landing": start.landing, "stem": start.stem},
            "figures": {"part": str(start.upper), "limit": start.limit},
            "look": {name: bool(getattr(owners["Look"], name)) for name in ("dark", "large")},
            "playing": playing_of(owners, "face=" in link), "said": " ".join(filter(None, said)),
            "open": {name: of_view(owners[name]) for name, of_view in OF_VIEWS.items() if name in owners},
            "motion": motion_of(start, float(texts_of(link).get("seconds", 5.0))),
        }  # fmt: skip
        if start.pushes:  # each at s, mm along 1', 2', 3 from O, mN s
            found["pushes"] = start.pushes
        return rounded(found)


def said_by(view):
    """What a view says of values that cannot be."""
    if isinstance(view, Lab):
        return view.scene.messages.values() if view.scene else ()
    return [view.wording.object] if "alert" in view.wording.object else ()


def rounded(found):
    """The same with DIGITS digits, and lists for tuples."""
    if isinstance(found, dict):
        return {name: rounded(value) for name, value in found.items()}
    if isinstance(found, (list, tuple)):
        return [rounded(value) for value in found]
    if isinstance(found, (float, np.floating)):
        return float(f"{found:.{DIGITS}g}")
    return found


def of_phone(shown):
    """What a student's link opens, where there is no such class."""
    [phone], [lesson] = shown.select(Phone), shown.select(LessonView)
    with patch.object(type(pn.state), "onload", lambda state, act: act()):
        phone.mark = 32 * "0"
    return {"language": text.spoken(), "room": "vote", "said": lesson.state["wording"]}


def start_of(start):
    names = ("theta", "theta_dot", "omega2", "omega3", "phi", "psi", "K_J", "K_R", "E")
    hand = ("spin", "tilt", "slip") if start.given == "hand" else ()
    return {"given": start.given} | {name: getattr(start, name) for name in (*names, *hand)}


def friction_of(start):
    """Of the ordinary table."""
    numbers = {name: getattr(start, name) for name in OF_LAW[start.law]}
    return {"law": start.law} | numbers | {"mu_s": start.static}


def playing_of(owners, has_face):
    playing, clock = owners["Playing"], owners["Clock"]
    face = {"face": owners["Controls"].face} if has_face and "Controls" in owners else {}
    shows = [name for name, parameter in SHOWN.items() if getattr(playing, parameter)]
    return {"time": clock.at, "speed": playing.speed, "camera": playing.camera, "shows": shows} | face


# ---- what is open in a room ----


def of_lesson(learn):
    """class: what the screen has of one."""
    return {"step": learn.step, "section": learn.section, "class": learn.lesson.state.get("wording", "")}


def of_map(choice):
    asked = choice.request
    sides = {"across": [asked.across, *asked.across_range], "up": [asked.up, *asked.up_range]}
    fixed = {name: value for name, value in asked.start.items() if name not in (asked.across, asked.up)}
    one = asked.at(*choice.place)
    motion = slid(one.top, one.state, one.friction, one.scales, one.edge, asked.seconds, "plastic")
    return sides | {"law": asked.law, "body": asked.body, "seconds": asked.seconds, "cells": asked.cells,
                    "fixed": fixed, "colours": choice.colour, "bead": choice.place,
                    "motion": motion}  # fmt: skip


def of_film(filmed):
    if not filmed.film:
        return {"film": None}
    plain = film.unpacked(filmed.film)
    said = film.opened(plain)
    table = [line for line in plain.splitlines()[2:] if line]
    return {"film": {"law": said.law, "free": said.loose, "part": said.part, "rows": len(table), "first": table[0],
                     "last": table[-1], "R": said.scales.R, "M": said.scales.M,
                     "fits": [each["values"] for each in said.fits]}}  # fmt: skip


OF_VIEWS = {"Learn": of_lesson, "MapChoice": of_map, "Filmed": of_film}


# ---- the motion ----


def motion_of(start, seconds):
    """{table: numbers of the motion} on the table that is watched, or on all three; up to this time."""
    top, scales = start.scene.top, start.shape.scales
    state = start.let_go
    edge = start.shape.edge if start.stem and start.scene.shape is not None else None
    friction = {"contact": lambda: Contensou(start.mu, 1e-3 * start.patch / scales.R),
                "coulomb": lambda: Coulomb(start.mu, start.static), "viscous": lambda: Viscous(start.gamma),
                "smoothed": lambda: SmoothedCoulomb(start.mu, start.eps)}[start.law]  # fmt: skip
    on = {"ordinary": lambda: slid(top, state, friction(), scales, edge, seconds, start.landing),
          "rough": lambda: rolled(top, state, scales), "ice": lambda: glided(top, state, scales)}  # fmt: skip
    found = {}
    for table in on if start.table == "three" else (start.table,):
        try:
            found[table] = on[table]()
        except TopError as error:
            found[table] = {"impossible": error.name}
    return found


def seen(moved):
    """What is seen of a motion at its times after the first: the tilt in degrees, and where its axis leans, as the
    horizontal part of a unit vector, because a top that passes near upright may go round on either side."""
    theta, phi = moved.theta[1:], moved.phi[1:] - moved.phi[0]
    leans = np.sin(theta)[:, None] * np.column_stack([np.sin(phi), -np.cos(phi)])
    return {"tilt": np.degrees(theta).tolist(), "leans": leans.tolist()}


def slid(top, state, friction, scales, edge, seconds, landing):
    """When it first lifts off or its stem touches, in s; and what there is before: when it passes 90 degrees, in s, and
    at SECONDS, as far as it is computed, what is seen, and the energy that friction has taken, in MgR."""
    times = np.array([0.0, *(each for each in SECONDS if each <= seconds)]) / scales.time
    if len(times) == 1:
        times = np.array([0.0, seconds / scales.time])
    moved = slide(top, state, friction, times, rtol=RTOL, landing=landing, edge=edge)
    hit = next(((t, name) for t, name in moved.events if name in HITS), None)
    until = hit[0] if hit else np.inf
    rows = int(np.searchsorted(moved.t, until))
    found = {name: values[: max(rows - 1, 0)] for name, values in seen(moved).items()}
    found["heat"] = moved.heat[1:rows].tolist()
    found["until"] = [hit[0] * scales.time, hit[1]] if hit else None
    found["on its side"] = moved.time_90 * scales.time if moved.time_90 < until else None
    return found


def rolled(top, state, scales):
    """What a rough table, which grips it first, makes of it: the tilts between which it nods and the time that this
    takes, in s, and what is seen."""
    gripped, lost = grip(top, state)
    start = State(gripped.theta, gripped.theta_dot, gripped.omega2, gripped.omega3, gripped.phi, gripped.psi)
    rolling = Rolling(top, None, start=start)
    moved = rolling(np.array([0.0, *SECONDS]) / scales.time)
    nods = {"between": np.degrees(rolling.turning_points).tolist(), "takes": rolling.period * scales.time, "lost": lost}
    return nods | seen(moved)


def glided(top, state, scales):
    """What is seen without friction."""
    return seen(glide(top, state, np.array([0.0, *SECONDS]) / scales.time))
