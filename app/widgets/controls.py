"""The controls of a motion that rolls: its constants or its state, friction, the top, and what the pictures show."""

import html
import math

import param

from app.model.inputs import INPUTS
from app.model.regimes import NAMES
from app.model.region import PAPER
from app.text import listed, say, written
from app.widgets.numbers import Numbers, choice, dock, heading, number, tidy, words
from app.widgets.typeset import LETTERS, typeset
from tippe_core import Top

SYMBOLS = {name: LETTERS[name] for name in ("K_J", "K_R", "mu_s", "I1", "I3", "theta", "theta_dot", "omega2", "mu")} | {
    "energy": "<i>E</i>", "a": "<i>a</i>", "omega3": LETTERS["omega_3"], "spin": LETTERS["omega_3"],
    "tilt": "<i>θ</i>", "angle": "<i>θ</i>", "slip": "<i>u</i>", "seconds": "<i>t</i>", "time": "<i>t</i>",
    "eps": "<i>ε</i>", "patch": "<i>ρ</i>", "gamma": "<i>γ</i>", "normal": LETTERS["F_z"],
    "ratio": "<i>F</i><sub>h</sub>/<i>F</i><sub>z</sub>",
    "height": "<i>f</i><sub>1</sub><sup>2</sup>&hairsp;<i>θ̇</i>&hairsp;<sup>2</sup>",
}  # fmt: skip
SPIN = "(<i>g</i>/<i>R</i>)<sup>½</sup>"
# Lines of words below, reserved so that nothing moves while a hand is on a slider.
LINES = {"K_J": 1, "K_R": 3, "energy": 5, "omega3": 5}
FACES = {"constants": ("K_J", "K_R", "energy"), "state": ("theta", "theta_dot", "omega2", "omega3")}
PICTURES = {"upper": {"whole": True, "poles": False, "paper": PAPER}, "limit": {"lift": "lift-off", "slip": "slip"}}
"""{input: {option: its value}}."""
OF_A_MOTION = ("K_J", "K_R", "mu_s", "energy", "a", "I1", "I3", *FACES["state"])


def hints(language=None):
    """{name of a symbol: what it is}."""
    of_inputs = {name: wording["hint"] for name, wording in listed("controls.inputs", language).items()}
    return listed("controls.hints", language) | of_inputs


def named(name):
    """A symbol, whose name is shown on hover."""
    return f'<span title="{html.escape(hints()[name])}">{SYMBOLS[name]}</span>'


def worst(scene):
    """What the motion does, in the words for its worst instant."""
    return say(f"regimes.way.{NAMES[scene.regime.max()]}")


def control(name, **more):
    """The part of a group for one input."""
    wording, symbol = listed(f"controls.inputs.{name}"), SYMBOLS[name]
    wording = wording | {"name": wording["spoken"], "symbol": symbol, "html": f"{symbol} {wording['name']}"}
    return number(name, wording, lines=LINES.get(name, 0), **more)


def track(name, value, bounds=None):
    """(least, most, step, decimals) of its slider, which reaches to the value."""
    return *INPUTS[name].track(value, bounds), INPUTS[name].step, None


def values_of(scene):
    """{input: its last valid value} of a rolling motion."""
    return {
        "K_J": scene.constants.K_J, "K_R": scene.constants.K_R, "energy": scene.share, "mu_s": scene.mu_s,
        **{name: getattr(scene.state, name) for name in FACES["state"]},
        **{name: getattr(scene.top, name) for name in ("a", "I1", "I3")},
    }  # fmt: skip


def valid(scene):
    """The motion that is still shown though a value of its was refused, in words; "" if none was."""
    name = next(iter(scene.messages), None)
    if name is None:
        return ""
    value = scene.constants.E if name == "energy" else values_of(scene)[name]
    return f"{listed('controls.inputs')[name]['spoken']} {tidy(value)}"


class Controls(param.Parameterized):
    """All controls. ask: called with inputs of the Explorer; back: gives those of before a value was refused. show() is
    for a hand at rest, follow() for each scene. card() contains all of them."""

    face = param.Selector(default="constants", objects=list(FACES), doc="which face is shown; it changes nothing else")

    def __init__(self, scene, ask, back=dict):
        super().__init__()
        self._scene, self._ask, self._back = scene, ask, back
        self._refused = set()  # the controls that show an error
        self._used = None  # the last control that was used: it shows the error if the motion is impossible
        self.numbers = Numbers(self._parts(), self._request)
        self.param.watch(lambda event: self.show(self._scene), "face")
        self.show(scene)

    def card(self):
        """The inputs of the motion and the friction; those of the top; and what Figs. 5 and 6 show."""
        return self.numbers.view

    @staticmethod
    def _parts():
        motion, faces = say("roll.sections.motion"), {face: say(f"controls.faces.{face}") for face in FACES}
        marks = {"energy": enumerate(listed("controls.marks"))}
        by = [control(name, marks=marks.get(name, ())) for names in FACES.values() for name in names]
        shows = [choice(name, say("roll.sections.pictures"), {key: say(f"roll.switches.{key}") for key in values})
                 for name, values in PICTURES.items()]  # fmt: skip
        return [
            heading(motion, choice("face", motion, faces)), dock(motion, *by, control("mu_s")), words("other"),
            heading(say("roll.sections.top")), *(control(name) for name in ("a", "I1", "I3")),
            heading(say("roll.sections.pictures")), *shows,
        ]  # fmt: skip

    def _request(self, name, value, typed):
        if name == "face":
            self.face = value
            return
        if name in PICTURES:
            self._ask(**{name: PICTURES[name][value]})
            return
        self._used = name
        if not typed and name in self._refused and value == values_of(self._scene)[name]:
            self._ask(**self._back())
        elif name in FACES["state"]:
            self._ask(**{name: value}, given="state")
        elif name == "energy" and typed:
            self._ask(E=value, given="E")
        elif name in FACES["constants"]:
            self._ask(**{name: value}, given="share")
        else:
            self._ask(**{name: value})

    def show(self, scene):
        """Shows a scene on all controls; what is wrong at a control of the face that is hidden, at one that is not."""
        self._scene = scene
        hidden = [name for face, names in FACES.items() if face != self.face for name in names]
        near = FACES[self.face][0] if self._used in {None, *hidden} else self._used
        at = {name: near if name in hidden else name for name in scene.messages}
        self._refused = {*at.values()}
        values = values_of(scene)
        for name, options in PICTURES.items():
            values[name] = next(key for key, value in options.items() if value == scene.inputs[name])
        energy = "E" if scene.inputs.get("given") == "E" else "energy"
        self.numbers.show(
            values | {"face": self.face}, self._sliders(scene, values), fields={"energy": scene.constants.E},
            notes=self._notes(scene), messages={at[name]: typeset(wording) for name, wording in scene.messages.items()},
            refused={each: scene.inputs[energy if each == "energy" else each] for each in at.values()},
            nearest={name: value for name, value in scene.nearest.items() if name not in hidden}, hidden=hidden,
            words={"other": self._other_face(scene)},
        )  # fmt: skip

    def follow(self, scene):
        """Shows the values of a scene at once."""
        self._scene = scene
        values = values_of(scene)
        self.numbers.follow(values, self._sliders(scene, values), {"energy": scene.constants.E})

    @staticmethod
    def _sliders(scene, values):
        bounds = {"K_J": scene.plane.K_J_range}
        return {name: track(name, values[name], bounds.get(name)) for name in OF_A_MOTION}

    def _other_face(self, scene):
        """The face that is not given by the sliders."""
        other = "state" if self.face == "constants" else "constants"
        if other == "state":
            values = {name: getattr(scene.state, name) for name in FACES["state"]}
        else:
            constants = scene.constants
            values = {"K_J": constants.K_J, "K_R": constants.K_R, "energy": constants.E}
        each = ", ".join(f"{named(name)} = {written(value, '.4g')}" for name, value in values.items())
        return say(f"controls.other.{other}", values=each)

    @staticmethod
    def _notes(scene):
        marks, (inner, outer) = scene.marks, scene.turning
        limits = " · ".join(
            say(f"controls.notes.{name}", E=tidy(round(E, 4)))
            for name, E in (("steady", marks.steady), ("slip", marks.slip), ("lift", marks.lift))
            if math.isfinite(E)
        )
        nods = "motion" if f"{inner:.3f}" != f"{outer:.3f}" else "stays"
        motion = say(
            f"controls.notes.{nods}", worst=worst(scene),
            notes="".join(f" {html.escape(note)}" for note in scene.notes),
            theta=named("theta"), inner=inner, outer=outer, inner_degrees=math.degrees(inner),
            outer_degrees=math.degrees(outer),
        )  # fmt: skip
        printed = scene.constants.K_R == 10 and scene.top == Top.paper()
        return {
            "omega3": motion,
            "K_J": say("controls.notes.K_J", pole=tidy(round(scene.plane.pole, 4))),
            "K_R": say("controls.notes.K_R", spin=scene.upright_spin, turns=scene.turns, R=100 * scene.scales.R)
            + say("controls.notes.printed") * printed,
            "energy": f"{motion}<br>{say('controls.notes.energy', limits=limits)}",
        }
