"""The Lab: a top that is let go by a hand flips on an ordinary table, and does not on a rough one or on ice.

The picture, its controls and its words are one component of the browser; here its wishes become a Lab's, and what the
Lab then has becomes what the component draws.
"""

import re

import param

from app.bundle import Bundled, pack
from app.model.lab import TABLES, Lab
from app.state import asked
from app.state.keep import Field, Number, OneOf
from app.text import listed, say
from app.widgets.pacing import at_once
from app.widgets.top3d import pack_frames

INPUTS = ("spin", "tilt", "mu")
DIGITS = {"spin": 1, "tilt": 1, "mu": 2}
STEPS = {"spin": 0.1, "tilt": 0.1, "mu": 0.01}


class Toy:
    """One of the toys, by the place of its name, which is no word for a link."""

    def __init__(self, names):
        self._names = list(names)

    def text(self, value):
        """The place of a name; Unasked where there is no such toy."""
        if value not in self._names:
            raise asked.Unasked("no toy of that name")
        return str(self._names.index(value) + 1)

    def value(self, text):
        """The name at a place; else a ValueError."""
        if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= len(self._names):
            raise ValueError(say("share.link.one_of", words=f"1 ... {len(self._names)}"))
        return self._names[int(text) - 1]


def kept():
    """What of a Lab a link keeps."""
    return {
        "table": Field("table", OneOf(**{table: table for table in (*TABLES, "three")}), undoable=False),
        "toy": Field("toy", Toy(Lab.param.toy.objects)),
        "spin": Field("turns", Number),
        "tilt": Field("lean", Number),
        "mu": Field("rub", Number),
    }


class LabView(Bundled):
    """The whole tab: the top on its table, the tilt over time, what happens and why, one picture that answers, and the
    controls of the start.

    Each table has the frames of its motion, as `pack_frames` packs them, and its curves: float32 rows of the time (s),
    the tilt (degrees), the height of G, the energy and the heat so far (mm of height), the spin about its own axis and
    the turning seen from above (rev/s), and the code of the regime. Both are empty where there is no such motion.
    """

    SAYS = ("Stage", "Top3D")

    state = param.Dict(default={}, doc="All that is no array: the inputs, the runs in words, what was refused.")
    profile = param.Bytes(default=b"", doc="As of a Top3D.")
    a = param.Number(default=0.0, doc="G's distance below O, in R.")
    seconds = param.Number(default=1.0, bounds=(0, None), doc="Seconds of the real top in one unit of time.")
    frames_ordinary = param.Bytes(default=b"")
    frames_rough = param.Bytes(default=b"")
    frames_ice = param.Bytes(default=b"")
    curves_ordinary = param.Bytes(default=b"")
    curves_rough = param.Bytes(default=b"")
    curves_ice = param.Bytes(default=b"")
    asked = param.List(
        default=[], doc="[count, name, value] of what a person asks for, the browser writes it; state tells the last "
        "count that was answered. The names are a Lab's inputs, and research: the paper's figures."
    )  # fmt: skip

    @classmethod
    def says(cls, language=None):
        return super().says(language) | listed("lab_view.view", language)


def spelled(words):
    """Words with their numbers as the page's language writes them."""
    return re.sub(r"(?<=\d)\.(?=\d)", say("lab_view.view.decimal"), words)


class LabTab:
    """view: the tab. lab: the Lab it shows and asks; research: called for the paper's figures of this top and start;
    rests: called when a hand has changed something."""

    def __init__(self, lab, research, rests):
        self._lab, self._research, self._rests = lab, research, rests
        self._answered, self._shown, self._ends = 0, None, None
        self._refused = {}
        self.view = LabView(sizing_mode="stretch_width", margin=0)
        at_once(self.view, "asked")
        self.view.param.watch(asked.heard(self._heard), "asked")
        lab.param.watch(lambda event: self.show(), ["scene", "table", "ends", "busy"])
        self.show()

    def _heard(self, event):
        """A wish of the browser."""
        count, name, value = asked.parts(event.new, asked.number, asked.text, asked.anything)
        self._answered = int(count)
        if name == "research":
            self._research()
        elif name in ("table", "toy"):
            if value not in self._lab.param[name].objects:
                raise asked.Unasked(f"not one of the objects of {name}")
            self._lab.ask(**{name: value})
        elif name in INPUTS:
            self._refused = {name: value}
            self._lab.ask(**{name: value})
        else:
            raise asked.Unasked("not an input of the Lab")
        self._rests()
        self.show()

    def show(self):
        """What the Lab has now."""
        lab, scene = self._lab, self._lab.scene
        changes = {"state": self._state(lab, scene)}
        if scene is not None and scene is not self._shown:
            self._shown = scene
            changes |= {"profile": pack(scene.profile), "a": scene.top.a, "seconds": scene.scales.time}
            for table in TABLES:
                motion = scene.motions[table]
                changes[f"frames_{table}"] = pack_frames(*motion.frames) if motion else b""
                changes[f"curves_{table}"] = pack(motion.curves) if motion else b""
        self.view.param.update(**changes)

    def _state(self, lab, scene):
        names = listed("workshop.presets")
        messages = {name: spelled(sentence) for name, sentence in (scene.messages if scene else {}).items()}
        return {
            "table": lab.table,
            "toy": lab.toy,
            "toys": [[toy, names[toy]["name"]] for toy in lab.param.toy.objects],
            "values": {name: getattr(lab, name) for name in INPUTS},
            "limits": {name: self._limits(name) for name in INPUTS},
            "messages": messages,
            "refused": {name: value for name, value in self._refused.items() if name in messages},
            "old": self._old(lab, scene, messages),
            "runs": {table: self._run(scene, table) for table in TABLES},
            "ends": [list(end) for end in lab.ends] if lab.ends else None,
            "R": 1e3 * scene.scales.R if scene else 1.0,
            "answered": self._answered,
            "busy": bool(lab.busy),
        }

    def _limits(self, name):
        low, high = self._lab.param[name].softbounds or self._lab.param[name].bounds
        return {"low": low, "high": high, "step": STEPS[name], "digits": DIGITS[name]}

    @staticmethod
    def _old(lab, scene, messages):
        """What the pictures are of, where that is not what was asked for."""
        name = next(iter(messages), None)
        if name not in INPUTS:
            return ""
        said = listed(f"lab_view.view.inputs.{name}")
        gap = "" if said["unit"] in ("", "°") else " "
        return spelled(f"{said['name']} {getattr(lab, name):.{DIGITS[name]}f}{gap}{said['unit']}")

    @staticmethod
    def _run(scene, table):
        """In words; None before there is any."""
        if scene is None:
            return None
        motion = scene.motions[table]
        if motion is None:
            return {"events": [], "stages": [], "keeps": [], "why": spelled(scene.why[table])}
        return {
            "events": [[t, code, spelled(word), spelled(short)] for t, code, word, short in motion.events],
            "stages": [[t, *map(spelled, said)] for t, *said in motion.stages],
            "keeps": [[mark, word, spelled(numbers)] for mark, word, numbers in motion.keeps],
            "why": "",
        }
