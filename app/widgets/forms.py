"""What a hand sets or presses, beside number controls: buttons, entries, choices, menus, checks, a stretch with two
ends, a file of text, and a fold. Each is drawn by native elements of the browser, in the style of the Lab."""

import math

import panel as pn
import param

from app.borrowed import at_once
from app.bundle import Bundled
from app.state import validate
from app.text import say
from app.widgets.hold import held

MOST_CLICKS = 10  # in one message


def hear(component, **does):
    """Calls does[name] with each event of what the browser sends as this property; it arrives without delay."""
    at_once(component, *does)
    for name, act in does.items():
        component.param.watch(validate.handler(act), name)


def one_of(known):
    """A reader for validate.parts: one of these texts."""

    def read(value):
        if isinstance(value, str) and value in known:
            return value
        raise validate.InvalidMessage(f"not offered: {value!r:.40}")

    return read


def typed_number(text):
    """The number that was typed; raises ValueError."""
    value = float(text.replace("−", "-").replace(",", "."))
    if not math.isfinite(value):
        raise ValueError
    return value


class Part(Bundled):
    """What these have in common."""

    label = param.String(default="", doc="Its name, in words.")
    SENDS = ()  # what the browser sets
    _is_put = False

    def __init__(self, label="", **params):
        super().__init__(label=label, **({"margin": 0} | params))
        at_once(self, *self.SENDS)

    def on(self, name, act):
        """Calls act(event) when this value changes; all changes that it makes on the page are sent as one message."""

        def heard(event):
            if not self._is_put:
                with held():
                    act(event)

        self.param.watch(heard, name)

    def put(self, **values):
        """Sets values without a call of the functions of on(): no hand has set them."""
        self._is_put = True
        try:
            self.param.update(**values)
        finally:
            self._is_put = False


class Button(Part):
    """does: called at each click.

    The browser counts the clicks, so none is lost. One that arrives after the button was disabled does nothing.
    """

    kind = param.Selector(default="outline", objects=["primary", "outline", "link"])
    disabled = param.Boolean(default=False)
    clicks = param.Integer(default=0)
    SENDS = ("clicks",)

    def __init__(self, label, does=None, **params):
        super().__init__(label, **params)
        self._does = [] if does is None else [does]
        self.on("clicks", self._clicked)

    def on_click(self, does):
        """From now on calls this, too."""
        self._does.append(does)

    def _clicked(self, event):
        for _ in range(min(event.new - event.old, MOST_CLICKS)):
            if not self.disabled:
                for does in self._does:
                    does()


class Field(Part):
    """An entry for a short text, such as a number. refuse() shows why the browser's last text cannot be."""

    value = param.String(default="")
    shows = param.String(default="", doc="Its name as it is shown, in HTML; empty: only screen readers get the label.")
    unit = param.String(default="", doc="Behind it.")
    placeholder = param.String(default="", doc="Shown while it is empty.")
    size = param.Integer(default=8, doc="Its width, in letters.")
    wrong = param.List(default=[], doc="[why, nearest possible text or empty, text to go back to or empty].")
    SENDS = ("value",)

    def refuse(self, why="", nearest="", back=""):
        """why: plain text; empty: nothing is wrong."""
        self.wrong = [why, nearest, back] if why else []

    def number(self, key, back="", **named):
        """The number that was typed. If it is none, says so, in the words under this key, and raises ValueError."""
        try:
            found = typed_number(self.value)
        except ValueError:
            self.refuse(say(key, text=self.value, **named), back=back)
            raise
        self.refuse()
        return found


class Choice(Part):
    """One of several is chosen, by buttons; what stands for each is a text or a whole number."""

    options = param.Dict(default={}, doc="{word on the button: value}.")
    value = param.Parameter(doc="One of the values.")
    SENDS = ("value",)

    def __init__(self, options, value, label="", **params):
        super().__init__(label, options=options, value=value, **params)

    @classmethod
    def of(cls, owner, name, options, **layout):
        """The choice of a parameter, which it follows."""
        made = cls(options, getattr(owner, name), **layout)
        made.on("value", lambda event: setattr(owner, name, event.new))
        owner.param.watch(lambda event: setattr(made, "value", event.new), name)
        return made


class Menu(Part):
    """One of several is chosen, from a list that opens; what stands for each is a text or a whole number."""

    options = param.Dict(default={}, doc="{words: value}.")
    value = param.Parameter(doc="One of the values.")
    SENDS = ("value",)


class Checks(Part):
    """Any number of several."""

    options = param.Dict(default={}, doc="{words: value}.")
    value = param.List(default=[], doc="The values that are checked.")
    SENDS = ("value",)


class Stretch(Part):
    """A part of a range, between two thumbs. does: called when a thumb was let go, or a number typed."""

    start = param.Number(default=0.0)
    end = param.Number(default=1.0)
    step = param.Number(default=0.01)
    digits = param.Integer(default=3, doc="After the decimal point.")
    unit = param.String(default="")
    value = param.List(default=[0.0, 1.0])
    pulled = param.List(default=[0, 0.0, 1.0], doc="[how often so far, from, to]; the browser sets it")
    SENDS = ("pulled",)

    def __init__(self, label, does=None, **params):
        super().__init__(label, **params)
        self._does = does
        self.on("pulled", validate.handler(self._heard))

    def _heard(self, event):
        _, low, high = validate.parts(event.new, *3 * [validate.number])
        self.value = [low, high]
        if self._does:
            self._does()


class TextFile(Part):
    """A button that opens a file. take: called with its text; refuse: called if it is too large."""

    accept = param.String(default="")
    most = param.Integer(default=0, constant=True, doc="bytes")
    sent = param.List(default=["", 0, 0], doc="[its text, how many so far, its size in bytes]")
    SENDS = ("sent",)

    def __init__(self, label, take, refuse, **params):
        super().__init__(label, **params)
        self._take, self._refuse = take, refuse
        self.on("sent", validate.handler(self._heard))

    def _heard(self, event):
        text, _, size = validate.parts(event.new, validate.text, validate.number, validate.number)
        if math.isfinite(size) and size > self.most:
            self._refuse()
        else:
            self._take(text)


class Fold(Bundled):
    """What can be unfolded below a title."""

    label = param.String(default="")
    content = pn.viewable.Child(constant=True)

    def __init__(self, label, content, **params):
        super().__init__(label=label, content=content, **({"margin": 0, "sizing_mode": "stretch_width"} | params))
