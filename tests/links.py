"""Links of every kind that the page has made, and what each opened when it was made: python tests/links.py [LINK ...]

data/links.json keeps them. A link that somebody has put into a script of his course must open the same for ever, so
what stands there is never made anew; this adds the links that it is given. If the page is built otherwise, only
opened() is to follow.
"""

import json
import sys
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from unittest.mock import patch

import numpy as np
import panel as pn
from bokeh.document import Document
from panel.io.state import set_curdoc

from app import page, text
from app.model import lesson
from app.model.explorer import Explorer
from app.state.codecs import Body
from app.state.keep import Keep
from app.state.names import NAMES, of
from app.widgets import rooms

ROLL = "?v=1&tab=roll"  # what an address without a query opened, and said, before there was a Lab
TABS = ("roll", "three-planes", "build-a-top", "families", "learn", "maps", "measure")  # as they were numbered then
FILE = Path(__file__).parent / "data" / "links.json"


def known():
    """{link: what it opened}; a step of the ten that there were opens what tells it now, by the name it has now."""
    found = kept_links()
    for what in found.values():
        step = what["settings"].get("step")
        if step in lesson.BEFORE:
            what["settings"]["step"] = now = lesson.BEFORE[step]
            what["address"] = what["address"].replace(f"step={step}", f"step={now}")
        if "law" in what["settings"]:
            what["settings"].setdefault("patch", 0.5)  # mm; there was none of a real contact when the first were kept
    return found


def kept_links():
    """{link: what it opened}, as it was written."""
    return json.loads(FILE.read_text(encoding="utf-8"))


@contextmanager
def kept():
    """A list of (Keep, owner, {parameter: Name}) of all that a page keeps; a tab is made when it is asked for."""
    parts, add = [], Keep.add

    def noted(keep, owner, *rest, **named):
        add(keep, owner, *rest, **named)
        parts.append((keep, owner, of(type(owner).__name__)))

    with patch.object(Keep, "add", noted), patch.object(rooms.Place, "ask", rooms.Place.fill):
        yield parts


def opened(link):
    """What a link opens, of numbers, words and truth values: every setting by its name in a link; the language; the
    top, its body in SI and R, the motion and its turning points in units of R, M, g; what is said of the link."""
    with set_curdoc(Document()), kept() as parts:
        pn.state.location.search = link if link.strip("?") else ROLL
        page.page()
        if not parts:
            return {"language": text.spoken(), "settings": {}}  # a student's page
        [explorer] = [owner for _, owner, _ in parts if isinstance(owner, Explorer)]
        [seen] = [owner for _, owner, fields in parts if "room" in fields and "level" in fields]
        keep, scene = parts[0][0], explorer.scene
        face = NAMES["face"].codec.value(keep.waits.get("face", "constants"))  # was there on every page
        return {
            "language": text.spoken(),
            "settings": {"face": face}
            | {field.key: plain(field.codec, getattr(owner, name))
               for _, owner, fields in parts if owner is not seen for name, field in fields.items()}
            | {"tab": TABS.index(seen.room)},
            "body": {"R": scene.scales.R, "M": scene.scales.M, "height": float(np.ptp(scene.profile[:, 1]))},
            "top": asdict(scene.top),
            "motion": {name: float(getattr(scene.constants, name)) for name in ("K_J", "K_R", "E")},
            "turns": [float(theta) for theta in scene.turning],
            "wrong": sorted(scene.messages),
            "address": "" if keep.query == ROLL else keep.query,
            "said": keep.sentence.replace("lab, ", "").replace("a class, as", "a vote, as"),  # by their names then
        }  # fmt: skip


def plain(codec, value):
    """A setting as a number, a word, a truth value, or a list of numbers."""
    return codec.text(value) if codec is Body else value.item() if isinstance(value, np.generic) else value


def main(links):
    found = kept_links()
    found |= {link: opened(link) for link in links if link not in found}
    lines = (f"{json.dumps(link)}: {json.dumps(what, ensure_ascii=False)}" for link, what in found.items())
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
