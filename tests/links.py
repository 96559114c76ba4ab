"""Links of every kind that the page has made, and what each opened when it was made: python tests/links.py [LINK ...]

data/links.json keeps them. A link that somebody has put into a script of his course must open the same for ever, so
what stands there is never made anew; this adds the links that it is given. If the page is built otherwise, only
opened() is to follow, and met.py, which says what the newer links of version 2 open.
"""

import json
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np
import panel as pn
from bokeh.document import Document
from met import is_today, kept, opens, room_of, speed_of, today
from panel.io.state import set_curdoc

from app import text
from app.model.explorer import Explorer
from app.model.lesson import lesson
from app.page import page
from app.state.codecs import Body
from app.state.names import NAMES

ROLL = "?v=1&tab=roll"  # what an address without a query opened, and contained, before the Lab existed
TABS = ("roll", "three-planes", "build-a-top", "families", "learn", "maps", "measure")  # by their old numbers
PLANE = {"ordinary": "sliding", "rough": "rough", "ice": "smooth", "three": "compare"}
"""{table: its name in links of version 1}."""
FILE = Path(__file__).parent / "data" / "links.json"


MOTION = ("by", "KJ", "KR", "e", "E", "th", "thd", "w2", "w3", "phi", "psi")
HANDS = ("spin", "tilt", "slip")
BESIDE = (*HANDS, "law", "mu_k", "mu_stick", "gamma", "mu_smooth", "eps", "patch", "land", "stem", "plane")
"""What the three planes had of their own, beside a start and a friction of what rolls."""


def known():
    """{link: what it opened}; a step of the ten that there were opens what tells it now, by the name it has now. What a
    view had of its own that the link did not open is left out, and so is what had no effect in the one it did."""
    found = kept_links()
    found["?v=2&KJ=6.7"]["said"] = ""  # this version did not exist then
    for link, what in found.items():
        settings = what["settings"]
        settings.pop("seconds", None)  # a run now goes on to its end
        if "slow" in settings and "slow=" not in link:
            settings["slow"] = speed_of(link)
        step = settings.get("step")
        if step in lesson.BEFORE:
            settings["step"] = lesson.BEFORE[step]
        what.pop("address", None)  # as it was worded then
        if "law" in settings:
            settings.setdefault("patch", 0.5)  # mm; the first links were kept before there was a real contact
            what["settings"] = in_effect(settings)
            if settings["start"] == "spin":
                left = "motion", "turns"
                for name in left:
                    del what[name]
    return found


def in_effect(settings):
    """Those of the three planes that made the picture."""
    law, hand = settings["law"], settings["start"] == "spin"
    without = {*(MOTION if hand else HANDS), *({"mu"} if law == "coulomb" else {"mu_k", "mu_stick"})}
    if law not in ("smoothed", "contact"):
        without.add("mu_smooth")
    return {name: value for name, value in settings.items() if name not in without}


def kept_links():
    """{link: what it opened}, as it was written; without those that met.py describes."""
    return {link: what for link, what in written().items() if "settings" in what}


def met_links():
    """{link: what was met there}, of those that met.py describes."""
    found = {link: what for link, what in written().items() if "settings" not in what}
    del found["?v=3&KJ=6.7&mu=.4"]  # this version did not exist then
    for what in found.values():
        what.pop("written so", None)  # as it was worded then
    return {link: today(link, what) for link, what in found.items()}


def written():
    """All that the file contains."""
    return json.loads(FILE.read_text(encoding="utf-8"))


def opened(link):
    """What a link opens, of numbers, words and truth values: every setting by its name in a link; the language; the
    top, its body in SI and R, the motion and its turning points in units of R, M, g; what is said of the link."""
    with set_curdoc(Document()), kept(link) as parts:
        pn.state.location.search = link if link.strip("?") else ROLL
        page.page()
        if not parts:
            return {"language": text.spoken(), "settings": {}}  # a student's page
        [explorer] = [owner for _, owner, _ in parts if isinstance(owner, Explorer)]
        [seen] = [owner for _, owner, fields in parts if "room" in fields and "level" in fields]
        keep, scene = parts[0][0], explorer.scene
        face = NAMES["face"].codec.value(keep.waits.get("face", "constants"))  # then every page had it
        settings = {field.key: plain(field.codec, getattr(owner, name))
                    for _, owner, fields in parts if owner is not seen for name, field in fields.items()}  # fmt: skip
        settings["dark"] = bool(settings["dark"])  # None if nobody has chosen: then the system decides
        room, hand = room_of(link), explorer.given == "hand"
        planes = room == "three-planes"
        for name in ("table", "panel", "push", "trace"):  # of which those links knew nothing
            settings.pop(name, None)
        if planes:  # as in the three planes
            settings |= {"start": "spin" if hand else "constants", "plane": PLANE[explorer.table],
                         "mu_stick": explorer.mu_s, "mu_smooth": explorer.mu}  # fmt: skip
            settings = in_effect(settings)
        else:
            settings = {name: value for name, value in settings.items() if name not in BESIDE}
        found = {
            "language": text.spoken(),
            "settings": {"face": face} | settings | {"tab": TABS.index(room) if is_today(room, seen) else seen.room},
            "body": {"R": scene.scales.R, "M": scene.scales.M, "height": float(np.ptp(scene.profile[:, 1]))},
            "top": asdict(scene.top),
            "motion": {name: float(getattr(scene.constants, name)) for name in ("K_J", "K_R", "E")},
            "turns": [float(theta) for theta in scene.turning],
            "wrong": sorted(scene.messages),
            "said": keep.sentence.replace("of lab, ", "of roll, three-planes, ").replace("a class, as", "a vote, as"),
        }  # fmt: skip
        for name in ("motion", "turns") if planes and hand else ():
            del found[name]
        return found


def plain(codec, value):
    """A setting as a number, a word, a truth value, or a list of numbers."""
    return codec.text(value) if codec is Body else value.item() if isinstance(value, np.generic) else value


def main(links):
    found = written()
    found |= {link: opens(link) for link in links if link not in found}
    lines = (f"{json.dumps(link)}: {json.dumps(what, ensure_ascii=False)}" for link, what in found.items())
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
