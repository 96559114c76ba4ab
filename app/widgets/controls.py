"""The controls beside the pictures: each has a slider, an entry, and a sentence if its value is refused."""

import html
import math

import panel as pn
import panel_material_ui as pmui
import param

from app.borrowed import at_once
from app.bundle import Bundled
from app.model.regimes import NAMES
from app.model.region import PAPER
from app.state import asked
from app.text import listed, say, written
from app.widgets.cards import NOTES, PLAIN, alert, card, note, section
from app.widgets.said import said
from tippe_core import Top

STYLE = """
:host { font: calc(13px * var(--type, 1))/1.35 var(--family, system-ui, sans-serif); color: var(--ink, #22303c); }
""" + NOTES  # fmt: skip

SYMBOLS = {
    "K_J": "<i>K</i><sub>J</sub>",
    "K_R": "<i>K</i><sub>R</sub>",
    "mu_s": "<i>μ</i><sub>s</sub>",
    "energy": "<i>E</i>",
    "a": "<i>a</i>",
    "I1": "<i>I</i><sub>1</sub>",
    "I3": "<i>I</i><sub>3</sub>",
    "theta": "<i>θ</i>",
    "theta_dot": "<i>θ̇</i>",
    "omega2": "<i>ω</i><sub>2′</sub>",
    "omega3": "<i>ω</i><sub>3</sub>",
    "spin": "<i>ω</i><sub>3</sub>",
    "tilt": "<i>θ</i>",
    "slip": "<i>u</i>",
    "seconds": "<i>t</i>",
    "mu": "<i>μ</i>",
    "eps": "<i>ε</i>",
    "patch": "<i>ρ</i>",
    "gamma": "<i>γ</i>",
    "normal": "<i>F</i><sub>z</sub>",
    "ratio": "<i>F</i><sub>h</sub>/<i>F</i><sub>z</sub>",
    "height": "<i>f</i><sub>1</sub><sup>2</sup>&hairsp;<i>θ̇</i>&hairsp;<sup>2</sup>",
    "angle": "<i>θ</i>",
    "time": "<i>t</i>",
}
SPIN = "(<i>g</i>/<i>R</i>)<sup>½</sup>"
# start, end and step of each slider; a typed number may be outside
RANGES = {
    "K_J": (0, 9, 0.01),
    "K_R": (-20, 20, 0.05),
    "mu_s": (0, 1.5, 0.005),
    "energy": (0, 2.2, 0.005),
    "a": (-2, 0.5, 0.005),
    "I1": (0.05, 2, 0.001),
    "I3": (0.05, 2, 0.001),
    "theta": (0, math.pi, 0.005),
    "theta_dot": (-8, 8, 0.02),
    "omega2": (-8, 8, 0.02),
    "omega3": (-16, 16, 0.05),
    "spin": (0, 40, 0.1),
    "tilt": (0, 180, 0.5),
    "slip": (0, 1, 0.01),
    "seconds": (0.5, 30, 0.5),
    "mu": (0.01, 1, 0.005),
    "eps": (0.01, 1, 0.005),
    "patch": (0.05, 2, 0.05),
    "gamma": (0, 2, 0.01),
}
# Lines of words below, reserved so that nothing moves while a hand is on a slider.
LINES = {"K_J": 1, "K_R": 3, "energy": 5, "omega3": 5}
GRID = {"display": "grid", "grid-template-columns": "repeat(auto-fit, minmax(min(100%, 220px), 1fr))", "gap": "0 12px"}
NO_SCROLLING = ".scroll-button { display: none !important }"
FACES = {"constants": ("K_J", "K_R", "energy"), "state": ("theta", "theta_dot", "omega2", "omega3")}
PICTURES = {"upper": {"whole": True, "poles": False, "paper": PAPER}, "limit": {"lift": "lift-off", "slip": "slip"}}
OF_A_MOTION = ("K_J", "K_R", "mu_s", "energy", "a", "I1", "I3", *FACES["state"])


def number(value):
    return written(value, ".6g")


def named(name):
    """A symbol, whose name is shown on hover."""
    return f'<span title="{html.escape(say(f"controls.hints.{name}"))}">{SYMBOLS[name]}</span>'


def worst(scene):
    """What the motion does, in the words for its worst instant."""
    return say(f"regimes.way.{NAMES[scene.regime.max()]}")


class Dial(Bundled):
    """A control in the browser: a name, a slider, an entry, and words below.

    Only Python writes `told` and only the browser `asked`, so neither comes back as a request of the other. The browser
    counts its requests; `told` names the last request that it answers, and is ignored if there has been another since.
    """

    input = param.String(constant=True, doc="The name of its input.")
    title = param.String(constant=True, doc="Its symbol and name, as HTML.")
    hint = param.String(constant=True, doc="What it is, shown on hover.")
    spoken = param.String(constant=True, doc="Its name in plain words.")
    unit = param.String(constant=True, doc="Its unit in plain words.")
    marks = param.List(constant=True, doc="[value, word] of the named positions on the slider.")
    lines = param.Integer(default=0, constant=True, doc="Lines reserved for the words.")
    step = param.Number(default=0.01, constant=True, doc="Of the slider and of the arrow keys.")
    start = param.Number(default=0.0, doc="Of the slider.")
    end = param.Number(default=1.0, doc="Of the slider.")
    told = param.List(default=[0, 0.0, "0"], doc="[count, value, text]: for the slider and for the entry.")
    asked = param.List(default=[], doc="[count, number or text, whether it was typed].")
    words = param.String(default="", doc="HTML.")
    wrong = param.Boolean(default=False, doc="Whether what was typed is refused.")
    nearest = param.List(default=[], doc="[value, words] of a button that takes the nearest possible value, or [].")


def wording(words, wrong=False, nearest=None):
    """The properties of a Dial for these words: HTML, but plain text for an error; nearest: what can be taken."""
    take = [] if nearest is None else [nearest, say("lab_view.view.take", value=number(nearest))]
    return {"wrong": wrong, "words": alert(words) if wrong else note(words), "nearest": take}


def asked_of(sent):
    """(count, number or text, whether it was typed) of a request by a Dial in the browser."""
    count, wish, typed = asked.parts(sent, asked.number, asked.anything, bool)
    return int(count), asked.text(wish) if typed else asked.number(wish), typed


def typed_number(text):
    """The number that was typed; raises ValueError."""
    value = float(text.replace("−", "-").replace(",", "."))
    if not math.isfinite(value):
        raise ValueError
    return value


class Control:
    """One input of a view-model. request: called with its name and the requested number, and with typed=True if that
    was typed."""

    def __init__(self, name, value, request):
        self.name, self._request, self._heard, self._shown = name, request, 0, number(value)
        self._unread = False  # whether what was typed last is not a number
        self._stands = None  # the arguments of the last show(), as long as they still apply
        start, end, step = RANGES[name]
        spoken, unit = listed(f"controls.spoken.{name}")
        self.view = Dial(
            input=name,
            title=f"{SYMBOLS[name]}&ensp;{say(f'controls.names.{name}')}",
            hint=say(f"controls.hints.{name}"),
            spoken=spoken,
            unit=unit,
            marks=[list(mark) for mark in enumerate(listed("controls.marks"))] if name == "energy" else [],
            lines=LINES.get(name, 0),
            step=step,
            start=start,
            end=end,
            told=[0, value, self._shown],
            sizing_mode="stretch_width",
            margin=(0, 14, 8, 16),
        )
        at_once(self.view, "asked")
        self.view.param.watch(asked.heard(self._asked), "asked")

    def _asked(self, event):
        self._heard, wish, typed = asked_of(event.new)
        self._unread = False
        if not typed:
            self._request(self.name, wish)
            return
        try:
            value = typed_number(wish)
        except ValueError:
            self._unread = True
            self._say(say("controls.not_a_number", text=wish, shown=self._shown), wrong=True)
            return
        self._request(self.name, value, typed=True)

    def show(self, value, shown, note, message, bounds=None, nearest=None):
        """value: the input as it was solved; shown: the number for the entry; bounds: those of the slider, RANGES by
        default. A message replaces the note, and then the entry keeps what was typed, and a button takes the nearest
        possible value, if that is known. The same holds after text that is not a number, until the value changes."""
        wanted = (self._heard, value, shown, note, message, bounds, nearest)
        if wanted == self._stands or (self._unread and (message or number(shown) == self._shown)):
            return
        self._unread = False
        if message:
            self._say(message, wrong=True, nearest=nearest)
            return
        self.follow(value, shown, bounds, **wording(note))
        self._stands = wanted

    def follow(self, value, shown, bounds=None, **more):
        """Moves the slider and the entry to the value. more: other properties of the Dial, in the same message."""
        low, high = bounds or RANGES[self.name][:2]
        self._shown, self._stands = number(shown), None
        told = [self._heard, float(value), self._shown]
        self.view.tell(start=float(low), end=float(high), told=told, **more)

    def _say(self, words, wrong=False, nearest=None):
        self._stands = None
        self.view.tell(**wording(words, wrong, nearest))


def across(part):
    """Lets a part span all columns."""
    part.styles = part.styles | {"grid-column": "1 / -1"}
    return part


class Wish:
    """A widget that requests a value of one input when it is used by hand; show() sets it to the present value."""

    def __init__(self, view, name, ask):
        self.view, self._shown, self._name, self._ask = view, view.value, name, ask
        view.param.watch(self._chosen, "value")

    def _chosen(self, event):
        if event.new != self._shown:
            self._shown = event.new
            self._ask(**{self._name: event.new})

    def show(self, value):
        self._shown = value
        self.view.value = value


class Controls(param.Parameterized):
    """All controls. ask: called with inputs of the Explorer; soon: that of a Pacer. show() is for a hand at rest,
    follow() for each scene. card() contains all of them."""

    face = param.Selector(default="constants", objects=list(FACES), doc="which face is shown; it changes nothing else")

    def __init__(self, scene, ask, soon):
        super().__init__()
        self._scene, self._ask = scene, ask
        self._used = None  # the last control that was used: it shows the error if the motion is impossible
        self._busy = False  # whether a hand is on one of them
        self._controls = {name: Control(name, scene.inputs[name], self._request) for name in OF_A_MOTION}
        self._other = said(STYLE, margin=(2, 14, 0, 16), styles={"min-height": "calc(35px * var(--type, 1))"})
        self._switch = pmui.RadioButtonGroup.from_param(
            self.param.face,
            label="",
            options={say(f"controls.faces.{face}"): face for face in FACES},
            size="small",
            margin=(6, 16, 2, 16),
            sx=PLAIN,
        )
        self._faces = {face: pn.Column(sizing_mode="stretch_width", margin=0, stylesheets=[NO_SCROLLING])
                       for face in FACES}  # fmt: skip
        self.param.watch(lambda event: soon(self._turn), "face")
        self._pictures = {name: Wish(pmui.RadioButtonGroup(
            label="", value=scene.inputs[name], size="small", sx=PLAIN,
            options={say(f"roll.switches.{key}"): value for key, value in values.items()}), name, ask)
            for name, values in PICTURES.items()}  # fmt: skip
        self._turn()

    def card(self):
        """The inputs of the motion and the friction; those of the top; and what Figs. 5 and 6 show."""
        parts = [
            across(self._switch), *self._faces.values(), *self._views("mu_s"), across(self._other),
            across(section(say("roll.sections.top"))), *self._views("a", "I1", "I3"),
            across(section(say("roll.sections.pictures"))), *(across(wish.view) for wish in self._pictures.values()),
        ]  # fmt: skip
        return card(say("roll.sections.motion"), pn.Column(*parts, sizing_mode="stretch_width", margin=(0, -14),
                                                           styles=GRID), height="max-content")  # fmt: skip

    def _turn(self):
        for face, column in self._faces.items():
            shown = face == self.face
            # its parts are laid out in the grid around it, which a style sheet could not do for a hidden part
            column.styles = {"display": "contents" if shown else "none"}
            if shown and not column.objects:
                column.objects = self._views(*FACES[face])
        self.show(self._scene)

    def _request(self, name, value, typed=False):
        self._used, self._busy = name, True
        if name in FACES["state"]:
            self._ask(**{name: value}, given="state")
        elif name == "energy" and typed:
            self._ask(E=value, given="E")
        elif name in FACES["constants"]:
            self._ask(**{name: value}, given="share")
        else:
            self._ask(**{name: value})

    def _views(self, *names):
        return [self._controls[name].view for name in names]

    def show(self, scene):
        """Shows a scene on all controls, except those of the face that is hidden."""
        self._scene, self._busy = scene, False
        notes = self._notes(scene)
        hidden = {name for face, names in FACES.items() if face != self.face for name in names}
        near = FACES[self.face][0] if self._used in {None, *hidden} else self._used
        messages = {near if name in hidden else name: said for name, said in scene.messages.items()}
        for name, control in self._controls.items():
            if name in hidden:
                continue
            value = scene.inputs[name]
            shown = scene.constants.E if name == "energy" else value
            bounds = scene.plane.K_J_range if name == "K_J" else None
            control.show(value, shown, notes.get(name, ""), messages.get(name), bounds)
        for name, wish in self._pictures.items():
            wish.show(scene.inputs[name])
        self._other.text = self._other_face(scene)

    def follow(self, scene):
        """Shows at once what a hand elsewhere moves, for example on a picture."""
        self._scene = scene
        if not self._busy:
            self._controls["K_J"].follow(scene.constants.K_J, scene.constants.K_J, scene.plane.K_J_range)
            self._controls["energy"].follow(scene.share, scene.constants.E)

    def _other_face(self, scene):
        """The face that is not given by the sliders."""
        other = "state" if self.face == "constants" else "constants"
        if other == "state":
            values = {name: getattr(scene.state, name) for name in FACES["state"]}
        else:
            constants = scene.constants
            values = {"K_J": constants.K_J, "K_R": constants.K_R, "energy": constants.E}
        each = ", ".join(f"{named(name)} = {written(value, '.4g')}" for name, value in values.items())
        return note(say(f"controls.other.{other}", values=each))

    @staticmethod
    def _notes(scene):
        marks, (inner, outer) = scene.marks, scene.turning
        limits = " · ".join(
            say(f"controls.notes.{name}", E=number(round(E, 4)))
            for name, E in (("steady", marks.steady), ("slip", marks.slip), ("lift", marks.lift))
            if math.isfinite(E)
        )
        motion = say(
            "controls.notes.motion", worst=worst(scene), notes="".join(f" {html.escape(note)}" for note in scene.notes),
            theta=named("theta"), inner=inner, outer=outer, inner_degrees=math.degrees(inner),
            outer_degrees=math.degrees(outer),
        )  # fmt: skip
        printed = scene.constants.K_R == 10 and scene.top == Top.paper()
        return {
            "omega3": motion,
            "K_J": say("controls.notes.K_J", pole=number(round(scene.plane.pole, 4))),
            "K_R": say("controls.notes.K_R", spin=scene.upright_spin, turns=scene.turns, R=100 * scene.scales.R)
            + say("controls.notes.printed") * printed,
            "energy": f"{motion}<br>{say('controls.notes.energy', limits=limits)}",
        }
