"""A page without a server: a folder that any web host or a USB stick serves, with the Lab of one toy at the starts of a
grid, and the lesson without votes; or one file to mail, with the Lab at one start.

    tippe-top site DIR

It has the page's own components and the values that Python gives them. Its one script is a classic one with all data
in it, because a browser loads neither modules nor data from a file.
"""

import argparse
import base64
import gzip
import html
import json
import sys
from itertools import product
from math import prod
from pathlib import Path
from string import Template
from urllib.parse import urlsplit

import panel

from app.bundle import BUNDLE, as_json, classic, values_of
from app.model.arrival import MU, SPIN, TILT, TOY
from app.model.lab.lab import Lab
from app.model.lesson.lesson import LESSON
from app.model.runs import Runs
from app.model.setup import TABLES, TOYS
from app.page.first import CURVE, FRAME, POSE, written
from app.state.url_state import explorer_of, read
from app.tabs.lab.lab import SLIDERS, LabTab
from app.tabs.learn.lesson import LessonView, runs_of, state_of
from app.tabs.learn.worksheet import worksheet
from app.text import LANGUAGES, error_text, listed, say, speaking, spoken
from app.text import written as figure
from app.widgets import choices
from app.widgets.head import Head
from app.widgets.look import FAMILY
from tippe_core import TopError

MOST = 10_000_000  # bytes
GRID = {"spin": [float(spin) for spin in range(12, 41, 4)], "tilt": [5.0, 30.0], "mu": [0.1, 0.3]}
"""{input: its stored values} unless the arguments say otherwise: with them the folder has two thirds of MOST."""
KEEP = 13  # columns
NUMBERS = {f"{kind}_{table}": how for table in TABLES for kind, how in (
    ("frames", (FRAME, POSE, 2**10)), ("curves", (CURVE, CURVE, 2**7)), ("keeps", (KEEP, KEEP, 2**10)))}  # fmt: skip
FIRST = {"spin": SPIN, "tilt": TILT, "mu": MU}
PAGE = Template(Path(__file__).with_name("site.html").read_text(encoding="utf-8"))
ROOMS = "learn", "lab"
KATEX = """

site.js contains KaTeX too: MIT License, as above, Copyright (c) 2013-2020 Khan Academy and other contributors
"""
OPTIONS = {"spin": ("spins", "turns a second"), "tilt": ("tilts", "degrees"), "mu": ("frictions", "coefficients")}


def site(folder, toy=TOY, grid=GRID, look=lambda done, count: None):
    """Writes the folder, and returns its size in bytes. look: called after each start. Raises TopError for a start that
    is impossible, and ValueError for a value that the Lab refuses or if the folder would be larger than MOST."""
    notices = _notices()
    files = {
        "index.html": _page(script='<script src="site.js"></script>', lang="en"),
        "site.js": f"{typesetter()}\n{classic(site=stored(toy, grid, look))}",
        "THIRD_PARTY_NOTICES.txt": notices + KATEX,
    }
    size = sum(len(text.encode()) for text in files.values())
    if size > MOST:
        count, most = prod(map(len, grid.values())), MOST / 1e6
        raise ValueError(
            f"The folder would have {size / 1e6:.1f} MB (starts: {count}); "
            f"allowed are {most:.0f} MB. Name fewer values."
        )
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (Path(folder) / name).write_text(text, encoding="utf-8")
    return size


class WithoutEnds(Runs):
    """For a Lab without a slider of spins: the ends of its runs at other spins, which take long, are not computed."""

    def begin(self, run, kind, *pool):
        if kind != "ends":
            super().begin(run, kind, *pool)


def mailed(link, look, below="", **more):
    """The start that a link opens, on each table, as one HTML file (bytes), in the language of text.spoken(). look:
    {parameter of LabView: value}, how the top is shown, and at which time; below: HTML that follows; more: {function of
    the bundle: values} for it."""
    texts, _ = read(urlsplit(link).query)
    explorer, _ = explorer_of(texts)
    lab, table = Lab(WithoutEnds(), explorer), explorer.table
    lab.show()
    told, view = _tables(lab, {})
    toy, known = choices.tops(explorer.toy)
    state = head(toy, dict(known)[toy]) | {"tabs": [], "languages": [[spoken(), LANGUAGES[spoken()]]]}
    words = spoken_words(view, {"": told}, state) | {"about": say("share.letter.source")}
    says = words["lab"]["texts"]  # without the way to the lesson
    words["lab"] |= look | {"texts": says | {"whys": {}, "more": says["more"] | {"caught": ""}}}
    found = {"languages": {spoken(): spoken()}, "grid": {}, "first": {}, "table": table,
             "words": {spoken(): packed(as_json(words).encode())}, "runs": {"": _numbers(view)}}  # fmt: skip
    shown = html.escape(link)
    way = f'<p id="mailed">{say("share.letter.change")} <a href="{shown}">{shown}</a></p>' if link else ""
    script, notices = f"<script>{classic(site=found, **more)}</script>", f"<!-- {_notices()} -->\n"
    return _page(script=script, lang=spoken(), notices=notices, below=way + below).encode()


def _page(**parts):
    return PAGE.substitute({"title": say("main.title"), "family": FAMILY, "notices": "", "below": ""} | parts)


def _notices():
    return (BUNDLE.parent / "THIRD_PARTY_NOTICES.txt").read_text(encoding="utf-8")


def _tables(lab, grid, **start):
    """({table: [state, told]} of a start on each table and on all three, the view of all three)."""
    views = {table: shown(lab, grid, table=table, **start) for table in (*TABLES, "three")}
    return {table: [state, told] for table, (state, told, _) in views.items()}, views["three"][-1]


def _numbers(view):
    return base64.b64encode(written(view, NUMBERS)).decode()


def typesetter():
    """KaTeX, of Panel's files."""
    [script] = (Path(panel.__file__).parent / "dist/bundled/katex").glob("*/dist/katex.min.js")
    return script.read_text(encoding="utf-8")


def packed(text):
    return base64.b64encode(gzip.compress(text, 9, mtime=0)).decode()


def stored(toy, grid, look):
    """What site.js of the bundle shows: for each start the numbers of its runs, and the words in each language."""
    explorer, _ = explorer_of({})
    lab = Lab(explorer=explorer)
    lab.show()
    runs, words = {}, {language: {} for language in LANGUAGES}
    for values in product(*grid.values()):
        key = " ".join(f"{value:g}" for value in values)
        for language in LANGUAGES:
            with speaking(language):
                start = {"toy": toy, **dict(zip(grid, values, strict=True))}
                words[language][key], view = _tables(lab, grid, **start)
        runs[key] = _numbers(view)
        look(len(runs), prod(map(len, grid.values())))
    explorer.settle()
    first = {name: min(grid[name], key=lambda value: abs(value - at)) for name, at in FIRST.items()}
    found = {}
    for language in LANGUAGES:
        with speaking(language):
            name = listed("build.presets")[toy]["name"]
            listing = {name: "; ".join(figure(value, "g") for value in values) for name, values in grid.items()}
            around = {
                "about": say("site.about", toy=name, count=len(runs), **listing),
                "lesson": lesson(explorer.scene),
            }
            found[language] = packed(as_json(spoken_words(view, words[language], head(toy, name)) | around).encode())
    shows = {"runs": runs_of(LESSON, explorer.scene), "others": {}}
    return {"languages": {name: name for name in LANGUAGES}, "grid": grid, "first": first, "words": found, "runs": runs,
            "lesson": packed(as_json(shows).encode())}  # fmt: skip


def shown(lab, grid, **inputs):
    """(state, told, view) of a start in the Lab, without what the site does not have."""
    lab.ask(**inputs)
    lab.rest()
    if refused := lab.scene.messages:
        raise ValueError(" ".join(refused.values()))
    view = LabTab(lab, None).view
    state, told = json.loads(view.state), json.loads(view.told)
    spins = grid.get("spin", [0.0])  # without them, none of the ends is shown
    ends = [[max(low, min(spins)), min(high, max(spins)), *what] for low, high, *what in state["ends"] or ()
            if high > min(spins) and low < max(spins)]  # fmt: skip
    sliders = {name: slider(values, SLIDERS[name]) for name, values in grid.items() if len(values) > 1}
    return state | {"sliders": sliders, "dims": [], "ends": ends}, told | {"rubs": []}, view


def slider(values, known):
    """[least, most, step, decimals] of stored values, in steps from one to the next if they are even."""
    low, high = min(values), max(values)
    step = (high - low) / (len(values) - 1)
    even = all(abs(value - low - i * step) < 1e-9 for i, value in enumerate(sorted(values)))
    return [low, high, step if even else known[2], known[3]]


def spoken_words(view, words, state):
    """The head and the Lab in the language of the page; words: {start: of each table}; state: that of the head."""
    lab = {name: value for name, value in values_of(view).items() if name not in NUMBERS} | {"texts": type(view).says()}
    lab["texts"] |= {"nexts": {name: word for name, word in lab["texts"]["nexts"].items() if name != "research"}}
    lab["texts"] |= {"lets_go": "", "flick_hint": ""}  # a push is a run that is not stored
    return {
        "head": {"texts": Head.says() | dict.fromkeys(("tour", "keys", "statement"), ""), "request": [],
                 "state": state},
        "lab": lab, "told": words, "near": listed("site.near"), "no_number": listed("lab.inputs.no_number"),
    }  # fmt: skip


def lesson(scene):
    """The lesson in the language of the page, without what is for teachers."""
    texts = LessonView.says()
    texts |= {"lesson": texts["lesson"] | {"sections": {}, "open": ""}}
    steps = [state_of(step, scene) for step in LESSON]
    return {"texts": texts, "steps": steps, "worksheet": worksheet(scene), "request": []}


def head(toy, name):
    """The state of a Head."""
    tabs = [[each, say(f"main.tabs.{each}"), each] for each in ROOMS]
    return {"tabs": tabs, "levels": [], "rooms": [], "places": {}, "toy": toy, "toys": [[toy, name]],
            "language": spoken(), "languages": [list(each) for each in LANGUAGES.items()], "answered": 0}  # fmt: skip


def main(arguments):
    """`tippe-top site`; returns the code with which it ends."""
    says = "Writes the Lab of one toy, and the lesson, into a folder that opens without a server. A start takes 0.1 to"
    parser = argparse.ArgumentParser(prog="tippe-top site", description=f"{says} 0.2 MB; {MOST / 1e6:.0f} MB is most.")
    parser.add_argument("folder")
    parser.add_argument("--toy", default=TOY, choices=TOYS, help="(default: %(default)s)")
    for name, (option, says) in OPTIONS.items():
        usual = " ".join(f"{value:g}" for value in GRID[name])
        parser.add_argument(f"--{option}", dest=name, type=float, nargs="+", default=GRID[name],
                            help=f"{says} (default: {usual})")  # fmt: skip
    request = vars(parser.parse_args(arguments))
    grid = {name: sorted(set(request[name])) for name in GRID}
    try:
        size = site(request["folder"], request["toy"], grid, lambda *places: print(*places, sep="/", file=sys.stderr))
    except (ValueError, OSError) as error:
        print(error_text(error) if isinstance(error, TopError) else error, file=sys.stderr)
        return 2
    print(f"{request['folder']}: {size / 1e6:.1f} MB")
    return 0
