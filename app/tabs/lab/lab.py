"""The Lab: a top released by hand flips on an ordinary table, but not on a rough one or on ice.

The picture, its controls and its words are one component in the browser; its requests are passed to a Lab, and the
state of the Lab to the component, which draws it.
"""

import json
import math
from functools import partial

import panel as pn

from app.bundle import pack
from app.model.build.dimensions import FAMILIES, changed, nearest, sentence, value_of
from app.model.inputs import INPUTS
from app.model.lab.allowed import LIMITS, SHOWN
from app.model.lab.examples import EXAMPLES
from app.model.lab.lab import FIRST, Lab
from app.model.pushes import push_words
from app.model.setup import MOST_SECONDS, OF_LAW, shape_of
from app.state import validate
from app.state.codecs import Pushes
from app.state.names import LEVELS
from app.tabs.lab.view import LabView, capital, inputs
from app.tabs.lab.words import carried_words, notes, trace_words
from app.text import listed, say, speaking, spoken
from app.widgets.controls import valid
from app.widgets.failure import after
from app.widgets.forms import hear, one_of
from app.widgets.rest import Rest
from app.widgets.spelling import spelled
from app.widgets.top3d import pack_frames
from tippe_core import Top, TopError

SLIDERS = {name: (each.low, each.high, each.step, each.digits) for name, each in INPUTS.items() if name in LIMITS}
"""{input: (least, most, step, decimals) of its slider}, which grows for a value outside."""
SOON = 0.05  # s: a run that is done sooner is not shown as under way
LOOKS = 0.3  # s between two updates of the progress of a run


def dimensions(toy):
    """{input: Dimension} of the body's dimensions that can be set here."""
    family = () if isinstance(toy, Top) else FAMILIES[type(shape_of(toy))][1]
    return {f"dim:{each.name}": each for each in family if each.unit == "mm" or each.name == "a"}


def sizes(toy):
    """{input: its present value, in its unit}."""
    return {name: round(each.factor * value_of(shape_of(toy), each.name), 6) for name, each in dimensions(toy).items()}


def inputs_of(law):
    """The inputs with numbers that count with a law of friction."""
    return ("spin", "tilt", *OF_LAW[law])


def digits_of(dimension):
    """The number of decimals."""
    return max(0, -math.floor(math.log10(dimension.step)))


def _word(dimension):
    return capital(listed("lab.dimensions").get(dimension.key, dimension.words))


def lab_view(lab, keep, **leads):
    """The LabTab. lab: a Lab; keep: called when its start is to be kept, as it is then; leads: {"research", "why",
    "why_not": called to show the paper's figures, or a place of Learn}."""

    def rests():
        keep()
        lab.rest()

    tab = LabTab(lab, rests, **leads)
    if lab.inputs == FIRST:
        lab.show()  # stored, so that it is there as soon as the page
    if pn.state.loaded:
        begin(lab)
    else:
        pn.state.onload(partial(begin, lab))
    return tab


def begin(lab):
    """Starts what needs a thread, which a page has once it has loaded. Changes that do not come from this tab, such as
    undo, also end in rest()."""

    def still():
        if not lab.rests:
            lab.rest()

    lab.show()
    lab.rest()
    rest = Rest(still)
    lab.param.watch(lambda event: rest.moved(), "scene")


class LabTab:
    """view: the tab. lab: the Lab that it shows and controls; rests: called when a hand that has changed something is
    at rest; leads: as of lab_view()."""

    def __init__(self, lab, rests, **leads):
        self._lab, self._leads, self._rest, self._looks = lab, leads, Rest(rests), 0
        self._answered, self._confirmed, self._shown, self._tried, self._wrong, self._near = 0, None, None, {}, {}, {}
        self._rolls = ""
        self.view = LabView(sizing_mode="stretch_width", margin=0)
        hear(self.view, request=self._heard)
        lab.param.watch(self._changed, ["scene", "ends", "busy"])
        self.view.param.watch(self._opened, "level")
        self.show()

    def _opened(self, event):
        self._shown = None  # more is said
        self.show()

    def follow(self, scene):
        """Names the stage's picture as old while a value of the rolling motion, a Scene, is refused."""
        rolls = valid(scene)
        if rolls != self._rolls:
            self._rolls = rolls
            self.show()

    def _heard(self, event):
        """A request from the browser."""
        count, name, value = validate.parts(event.new, validate.number, validate.text, validate.anything)
        self._answered, looks = int(count), self._looks
        if name in self._leads:
            self._leads[name]()
        elif name == "stop":
            self._lab.stop()
        elif name == "example":
            self._lab.ask(**EXAMPLES[one_of(EXAMPLES)(value)])
        elif name == "pushes":
            self._push(validate.text(value))
        elif name in Lab.INPUTS or name in dimensions(self._lab.explorer.toy):
            self._tried[name], self._wrong, self._near = value, {}, {}
            self._lab.ask(**{name: value} if name in Lab.INPUTS else self._of_body(name, value))
        else:
            raise validate.InvalidMessage(name)
        self._rest.moved()
        if self._confirmed == self._answered:
            return
        if not self._lab.busy:
            self.show()
        elif self._looks == looks:  # else the run itself, or the next look at it, will show it
            self._wait(SOON)

    def _push(self, text):
        """Pushes the top, or says how often it can be pushed."""
        try:
            pushes = Pushes.value(text)
        except ValueError:
            self._wrong = {"pushes": say("lab.pushed.most", most=Pushes.MOST, seconds=MOST_SECONDS)}
            return
        self._wrong = {}
        self._lab.ask(pushes=pushes)

    def _of_body(self, name, value):
        """The inputs of the Lab for a dimension of the body, in its unit; none, and a sentence at that input, if there
        is no such body."""
        toy, dimension = self._lab.explorer.toy, dimensions(self._lab.explorer.toy)[name]
        try:
            number = validate.number(value)
        except validate.InvalidMessage:
            typed = str(value).strip()[:SHOWN] or say("lab.inputs.nothing")
            self._wrong[name] = say("lab.inputs.no_number", value=typed)
            return {}
        if number == sizes(toy)[name]:
            return {}
        try:
            return {"toy": changed(shape_of(toy), dimension.name, number / dimension.factor)}
        except TopError as error:
            self._wrong[name] = sentence(error)
            near = nearest(shape_of(toy), dimension, number)
            self._near = {} if near is None else {name: near}
            return {}

    def _changed(self, *events):
        """Shows a change; while a run is being computed, also its progress."""
        if all(event.name == "busy" and event.new for event in events):
            self._wait(SOON)
        else:
            self.show()

    def _wait(self, seconds):
        """Looks at the run after this time, instead of at the time set before."""
        self._looks += 1
        after(seconds, partial(self._look, self._looks))

    def _look(self, number):
        if number == self._looks and self._lab.busy:
            self.show()
            self._wait(LOOKS)

    def show(self):
        """Shows the present state of the Lab."""
        if self._lab.scene is not None:
            self._confirmed = self._answered
            with speaking(spoken()):  # set once, not for each word
                self._show(self._lab.scene)

    def _show(self, scene):
        changes = {"state": json.dumps(self._state(scene), allow_nan=False)}
        if scene is not self._shown:
            self._shown = scene
            changes |= {"told": json.dumps(self._told(scene), allow_nan=False), "profile": pack(scene.start.profile),
                        "a": scene.start.top.a, "seconds": scene.start.scales.time}  # fmt: skip
            for table, motion in scene.motions.items():
                changes[f"frames_{table}"] = pack_frames(*motion.frames) if motion else b""
                changes[f"curves_{table}"] = pack(motion.curves) if motion else b""
                changes[f"keeps_{table}"] = pack(scene.keeps[table]) if table in scene.keeps else b""
        self.view.tell(**changes)

    def _state(self, scene):
        lab, start, request = self._lab, self._lab.explorer, self._requested_start(scene)
        toy = start.toy
        values = {name: lab.value(name) for name in SLIDERS}
        sliders = {name: (*INPUTS[name].track(values[name]), *known[2:]) for name, known in SLIDERS.items()}
        messages = {name: spelled(wording) for name, wording in (scene.messages | self._wrong).items()}
        dims = dimensions(toy)
        sizes_of = {name: (each.low, each.high, each.step, digits_of(each)) for name, each in dims.items()}
        rolls = "" if self.view.level == LEVELS[0] else spelled(self._rolls)
        return {
            "toy": toy if isinstance(toy, str) else "",
            "values": values | sizes(toy),
            "sliders": sliders | sizes_of, "dims": [[name, _word(each), each.unit] for name, each in dims.items()],
            "law": self._law(start.law), "friction": [start.law, start.landing, start.stem], "messages": messages,
            "refused": {name: lab.refused.get(name, self._tried.get(name)) for name in messages},
            "nearest": {name: value for name, value in (lab.nearest | self._near).items() if name in messages},
            "old": next((self._named(scene.start, name) for name in messages if name in SLIDERS), rolls),
            "was": self._differ(scene.start, request), "wants": self._differ(request, scene.start),
            "ends": [list(end) for end in lab.ends.segments] if lab.ends else None,
            "answered": self._answered, "busy": lab.busy, "reached": lab.reached,
        }  # fmt: skip

    def _requested_start(self, scene):
        """The start that is asked for; the one that is shown if no body has these inertias."""
        try:
            return self._lab.inputs[1]
        except TopError:
            return scene.start

    def _told(self, scene):
        view, start, slides = listed("lab_view.view"), scene.start, scene.table in ("ordinary", "three")
        law, numbers = start.law, [name for name in OF_LAW[start.law] if name != "mu"]
        if self.view.level != LEVELS[0] and start.rolling is None:
            numbers.append("slip")
        wordings, ordinary = inputs(), scene.motions["ordinary"]
        (headline, why), dims, toy = scene.wording, dimensions(scene.toy), [repr(scene.toy), say("main.own")]
        if isinstance(scene.toy, str):
            toy = [scene.toy, listed("build.presets")[scene.toy]["name"]]
        return {
            "table": scene.table,
            "rubs": [[name, wordings[name]["typed"], wordings[name]["unit"]] for name in numbers] * slides,
            "of": {
                "law": [law, f"{view['law']}: {listed('planes.law')[law]}", f"{view['law']}:"],
                **{name: [getattr(start, name), self._named(start, name)] for name in inputs_of(law)},
                "toy": toy,
                "pushes": [Pushes.text(start.pushes), push_words(start.pushes), view["push"]],
                "table": [scene.table, f"{view['table']} {view['tables'][scene.table]}", view["table"]],
                **{name: [size, self._sized(dims[name], size), _word(dims[name])]
                   for name, size in sizes(scene.toy).items()},
            },
            "runs": {table: self._run(scene, table) for table in scene.motions},
            "wording": [spelled(headline), " ".join(filter(None, (spelled(why), self._law(law))))],
            "notes": notes(scene) if self.view.level != LEVELS[0] else {},
            "caught": ordinary is not None and ordinary.caught,
            "touches": start.shape is not None and start.shape.touch_angle is not None,
            "R": 1e3 * start.scales.R,
            "impulse": start.impulse,
            "whole": scene.whole,
        }  # fmt: skip

    @staticmethod
    def _sized(dimension, size):
        """A dimension with its value, in words."""
        return spelled(f"{_word(dimension)} {size:.{digits_of(dimension)}f} {dimension.unit}".strip())

    @staticmethod
    def _law(law):
        """A remark on the law of friction, unless it is the usual one."""
        return "" if law == "contact" else spelled(say(f"lab.laws.{law}"))

    def _differ(self, one, other):
        """The inputs in which two starts differ, in words, with the values of `one`."""
        names = (name for name in inputs_of(one.law) if getattr(one, name) != getattr(other, name))
        law = [listed("planes.law")[one.law]] if one.law != other.law else []
        law += [push_words(one.pushes)] if one.pushes != other.pushes else []
        return ", ".join([*law, *(self._named(one, name) for name in names)])

    @staticmethod
    def _named(start, name):
        """An input of a start with its value, in words."""
        wording, digits = inputs()[name], SLIDERS[name][-1]
        gap = "" if wording["unit"] in ("", "°") else " "
        number = f"{getattr(start, name):.{digits}f}".replace("-", "\N{MINUS SIGN}")
        return spelled(f"{wording['name']} {number}{gap}{wording['unit']}")

    @staticmethod
    def _jellett(scene):
        """How well its constant is kept while the top turns over, in words; "" if it does not."""
        if not scene.turning:
            return ""
        time, first, last = scene.turning
        return spelled(say("lab.kept.jellett", time=time, first=first, last=last))

    @staticmethod
    def _run(scene, table):
        """The run on a table in words; None if the table is not watched."""
        if table in scene.refused:
            return {"events": [], "stages": [], "caption": "", "why": spelled(scene.refused[table]), "jellett": "",
                    "trace": "", "carried": []}  # fmt: skip
        if table not in scene.stories:
            return None
        story = scene.stories[table]
        return {
            "events": [[t, code, spelled(word), spelled(short)] for t, code, word, short in story.events],
            "stages": [[t, *map(spelled, wording)] for t, *wording in story.stages],
            "caption": spelled(story.caption),
            "why": "",
            "jellett": LabTab._jellett(scene) if table == "ordinary" else "",
            "carried": [[t, spelled(word)] for t, word in carried_words(scene.motions[table])],
            "trace": spelled(trace_words(scene.motions[table].trajectory)),
        }
