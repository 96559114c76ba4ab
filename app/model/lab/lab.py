"""The view-model of the Lab: one start, and the table on which it is watched.

Only the newest request is computed, in a thread. The previous scene is shown until it is done, and stays if it cannot
be computed.
"""

from dataclasses import dataclass, field, replace
from functools import partial
from math import floor
from types import MappingProxyType
from typing import Any

import param

from app.model.arrival import TILT
from app.model.explorer import Explorer
from app.model.keeps import keeps, while_it_turns
from app.model.lab.allowed import LIMITS, POSSIBLE, below, fault, nearest, refusal
from app.model.lab.ends import Ends, ends_once, known_ends, of_spins
from app.model.run import SHIPS, TableMotion, check_pushes, motion_on, whole_on
from app.model.runs import LATER, Result, Run, Runs, Stopped
from app.model.setup import OF_LAW, TABLES, Setup, Toy
from app.model.side_by_side import of_all
from app.model.start import GIVEN, NUMBERS, USUAL, Start, arrives, of_toy
from app.model.story import Event, Stage, Story, story
from app.text import say
from app.together import set_together
from tippe_core import Outcome, TopError, outcome, strongest_friction
from tippe_core.types import Array

PATIENCE = 0.5  # s: a run may still finish within this time after a newer one was requested
OF_TOP = ("a", "I1", "I3")
BY_HAND = {"toy", *GIVEN["hand"]}  # what makes a start one by hand
Inputs = tuple[str, Setup]
FIRST: Inputs = SHIPS
IN_LAB = {"mu_k": "mu", "friction": "mu", "radius": "patch"}
"""{name of an input of the core: its name here}, where they differ."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LabScene:
    """Everything that the Lab shows. table, start: its inputs.

    motions: {table: TableMotion or None}; None if the table is not watched, or if there is no motion: then refused has
    a sentence that says why. stories: {table: Story} of these motions. wording: the headline and the explanation for
    all three together. keeps: {table: its keeps()} for all three; turning: while_it_turns() of the ordinary
    one. messages: {input: a sentence} for each input that was
    refused; the rest is then the last valid scene. whole: whether the motions are computed to their end.
    """

    table: str
    start: Setup
    motions: MappingProxyType[str, TableMotion | None]
    stories: MappingProxyType[str, Story]
    refused: MappingProxyType[str, str]
    wording: tuple[str, str]
    keeps: MappingProxyType[str, Array]
    turning: tuple[float, float, float] | None
    whole: bool
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def toy(self) -> Toy:
        """The body, by its name if it has one."""
        return self.start.toy

    @property
    def outcome(self) -> Outcome:
        """What friction would make of the ball alone."""
        return outcome(self.start.top, self.start.state)

    @property
    def events(self) -> tuple[Event, ...]:
        """The events on the table that is watched; if all three are shown, on the ordinary one."""
        return self._story.events

    @property
    def stages(self) -> tuple[Stage, ...]:
        """The stages of the motion whose events() are shown; if that motion is missing, one stage that says so."""
        return self._story.stages

    @property
    def watched(self) -> str:
        """The table whose motion is read: the one that is shown; if all three are, the ordinary one."""
        return "ordinary" if self.table == "three" else self.table

    @property
    def _story(self) -> Story:
        table, short = self.watched, say("lab.caption.refused")
        return self.stories.get(table) or Story((), (Stage(0.0, short, self.refused[table], short),), short)


def scene_of(table: str, start: Setup, *, whole: bool = False) -> LabScene:
    """The LabScene of a start, in the page's language; whole: to the end of the toy's life. Raises TopError, whose name
    is an input, if that input's value is impossible on all of the tables."""
    watched, seen = tuple(TABLES) if table == "three" else (table,), whole_on if whole else motion_on
    motions: dict[str, TableMotion | None] = dict.fromkeys(TABLES)
    refused: dict[str, str] = {}
    why: TopError | None = None
    for each in watched:
        try:
            motions[each] = seen(each, start)
        except TopError as error:
            if error.code in ("body-below-table", "below-sliding", "too-strong"):
                raise
            refused[each], why = refusal(error), error
    found = {name: motion for name, motion in motions.items() if motion is not None}
    check_pushes(start, [*found.values()], why)
    stories = {name: story(motion) for name, motion in found.items()}
    return LabScene(
        table=table, start=start, motions=MappingProxyType(motions),
        stories=MappingProxyType(stories), refused=MappingProxyType(refused),
        wording=of_all(found),
        keeps=MappingProxyType({name: keeps(motion) for name, motion in found.items()} if table == "three" else {}),
        turning=while_it_turns(found["ordinary"]) if "ordinary" in found else None,
        whole=whole or (table != "three" and all(motion.whole for motion in found.values())),
    )  # fmt: skip


class Lab(param.Parameterized):
    """Computes what the page's one start does on the Lab's tables; each result is one `scene` event. An input that is
    refused goes back to its previous value.

    explorer: has the start, which ask() changes; runs: the page's Runs. If several starts are requested while one is
    computed, only the newest of them is computed.
    """

    busy = param.Boolean(False, constant=True, doc="whether a newer start is being computed")
    scene = param.ClassSelector(class_=LabScene, constant=True, doc="the last result; None before show()")
    ends = param.Parameter(None, constant=True, doc="Ends over the slider's spins; None until they are computed")

    INPUTS = ("table", "toy", "spin", "tilt", "slip", "law", *NUMBERS, "landing", "stem", "pushes")

    def __init__(self, runs: Runs | None = None, explorer: Explorer | None = None) -> None:
        self.explorer = explorer or Explorer(**arrives())
        self._runs = runs or Runs()
        self._run: Run | None = None
        self._shown = self.begun = self._again = self.rests = False
        self._messages: dict[str, str] = {}
        self.refused: dict[str, object] = {}  # the values of a link, or of another room, that cannot be
        self.nearest: dict[str, float] = {}  # what can be, of each input that was refused as a number
        self._good = FIRST
        self._back = Start().changed(USUAL, **arrives()).put_back  # what sets the start back to it
        self._strip: Setup | None = None
        self._seen: Inputs | None = None  # the inputs at the last call of _follow()
        super().__init__()  # type: ignore[no-untyped-call]  # of param
        self.explorer.param.watch(self._follow, "start")

    @property
    def inputs(self) -> Inputs:
        """The present inputs."""
        return self.explorer.table, self.explorer.setup

    def value(self, name: str) -> Any:
        """The present value of an input."""
        return getattr(self.explorer, "static" if name == "mu_s" else name)

    def show(self) -> None:
        """Starts computing the present inputs; nothing is computed before the view is shown."""
        self._shown = self.begun = True
        self._follow()

    def hide(self) -> None:
        """Marks the view as hidden: nothing more is computed."""
        self._shown = False

    def ask(self, **inputs: object) -> None:
        """Sets the inputs that are valid; each of the others keeps its value, and the scene's messages say why. A new
        toy, spin, tilt or slip makes the start one by hand; to go back from one that was refused changes nothing."""
        goes_back = inputs.keys() <= self._messages.keys() and all(inputs[name] == self.value(name) for name in inputs)
        inputs = {} if goes_back else inputs
        faults = {name: fault(name, value) for name, value in inputs.items()}
        self._messages, self.refused = {name: wording for name, wording in faults.items() if wording}, {}
        self.nearest = {name: near for name in self._messages if (near := nearest(name, inputs[name])) is not None}
        found: dict[str, Any] = {name: value for name, value in inputs.items() if not faults[name]}
        if BY_HAND & found.keys():
            found["given"] = "hand"
        if "toy" in found:
            found |= of_toy(found.pop("toy"))
        self._set((self._back if self._fault else {}) | found)
        self._tell()

    def _set(self, inputs: dict[str, Any]) -> None:
        """Changes the start; how it would roll is solved when somebody will see it."""
        self.explorer.set(solve=False, **inputs)

    @property
    def _fault(self) -> TopError | None:
        """Why the start has no Setup."""
        try:
            self.explorer.setup  # noqa: B018
        except TopError as error:
            return error
        return None

    @property
    def reached(self) -> float:
        """How much of the present run is done, 0 to 1."""
        return self._run.reached if self._run else 0.0

    def stop(self) -> None:
        """Stops the present run; the inputs go back to those of the scene that is shown."""
        if self._run:
            self._run.stop()
            self._set(self._back)

    @property
    def _key(self) -> Setup | None:
        """The start of the Ends; None if it is not by hand with G at rest."""
        return of_spins(self.explorer.setup) if self.explorer.at_rest else None

    def rest(self) -> None:
        """To be called when no hand moves: looks up how the runs at all spins end, or has it computed in a thread."""
        self.rests = True
        self._live()  # before the ends at all spins, which take far longer
        key = self._strip = self._key
        self._put(ends=key and known_ends(key))
        if key and self.ends is None:
            work = Run(lambda run: ends_once(key, look=run.look), partial(self._ended, key))
            self._runs.begin(work, "ends", LATER)

    def _live(self) -> None:
        """Has the rest of the toy's life computed, if no hand moves and nothing else is being computed."""
        scene, inputs = self.scene, self._good
        if self.rests and scene is not None and not scene.whole and self._run is None:
            work = Run(lambda run: scene_of(*inputs, whole=True), partial(self._lived, inputs))
            self._runs.begin(work, "life", LATER)

    def _lived(self, inputs: Inputs, result: Result) -> None:
        """Shows the whole life in place of its beginning, if that is still what is shown."""
        scene = self.scene
        if isinstance(result, LabScene) and scene is not None:
            if inputs == self._good and not result.refused.keys() - scene.refused.keys():
                self._put(scene=replace(result, messages=scene.messages))
        elif not isinstance(result, Stopped):
            raise result

    def _ended(self, key: Setup, result: Result) -> None:
        if isinstance(result, Ends) and key == self._key:
            self._put(ends=result)
        elif isinstance(result, Exception) and not isinstance(result, Stopped | TopError):
            raise result

    def _put(self, **values: object) -> None:
        """Sets constant parameters; there is an event only if their values change."""
        with param.edit_constant(self):
            set_together(self, **values)

    def _follow(self, *events: param.parameterized.Event) -> None:
        """Computes the present inputs, now or when the present run is done."""
        if not self._shown:
            return
        law = OF_LAW[self.explorer.law]
        values = {name: self.value(name) for name in self.INPUTS if name in law or name not in NUMBERS}
        faults = {name: wording for name, value in values.items() if (wording := fault(name, value, POSSIBLE))}
        self.refused |= {name: values[name] for name in faults}
        self.nearest |= {name: near for name in faults if (near := nearest(name, values[name])) is not None}
        error = self._fault
        if error is not None and (error.name in OF_TOP or self.explorer.given != "hand"):
            return  # an input that is not the Lab's; its own control says why, and keeps the value until it is changed
        if error is not None:
            faults["tilt"] = refusal(error)  # which any start by hand has
        if faults:  # they came from a link, or from another room
            self._messages |= faults
            self._set(self._back)
            self._tell()
            return
        if events and self.inputs == self._seen:
            return  # only what does not count for these runs has changed
        self._seen = self.inputs
        if self._strip != self._key:
            self._put(ends=None)
        self.rests = False
        if self.scene is not None and self.inputs == self._good and self._run is None:
            return
        if self._run is None:
            self._begin()
        else:
            self._again = True
            if self._run.elapsed > PATIENCE:
                self._run.stop()

    def _begin(self) -> None:
        inputs, self._again = self.inputs, False
        work = Run(lambda run: scene_of(*inputs), partial(self._done, inputs, self.explorer.put_back))
        if inputs == FIRST or not self._runs.beside:  # the result that ships needs no thread
            work.done(work.result())
            return
        self._run = work
        self._put(busy=True)
        self._runs.begin(work, "lab")

    def _done(self, inputs: Inputs, back: dict[str, Any], result: Result) -> None:
        self._run = None
        if self._again:
            self._begin()
            if self._run is None:  # the new run has already been answered
                return
        idle = {"busy": False} if self._run is None else {}
        if isinstance(result, LabScene):
            self._good, self._back = inputs, back
            self._put(scene=result, **idle)
            self._tell()
            self._live()
            return
        self._put(**idle)
        if isinstance(result, TopError):
            self._refused(inputs, result)
        elif not isinstance(result, Stopped):
            raise result

    def _refused(self, inputs: Inputs, error: TopError) -> None:
        """Sets a refused input back; takes a push away; if a new body cannot have this tilt, it gets the tilt of the
        last scene or the default."""
        name = IN_LAB.get(error.name, error.name if error.name in LIMITS else "tilt")
        name = "pushes" if inputs[1].pushes else name
        self._messages[name] = refusal(error)
        if error.code == "body-below-table":
            self.nearest[name] = floor(10 * error.numbers["most"]) / 10  # its slider's digits
        elif error.code == "below-sliding":
            self.nearest[name] = inputs[1].mu
        elif error.code == "too-strong":
            self.nearest[name] = below(strongest_friction(inputs[1].top))
        if self.inputs != inputs:
            return  # another start has been requested meanwhile
        good = self._good[1]
        known = good.toy == self.explorer.toy and self.scene
        back = self._back
        if name == "pushes":
            here = replace(inputs[1], pushes=good.pushes, seconds=good.seconds) == good
            back = {"pushes": (here and good.pushes) or inputs[1].pushes[:-1]}  # the others may be of a link
        elif name == "tilt" and self.explorer.at_rest:
            back = {"tilt": good.tilt if known else TILT}
        elif name in self.nearest and self._differs_elsewhere(inputs[1]):
            back = {name: self.nearest[name]}  # the rest, which may be of a link, stays
        self._set(back)
        self._tell()

    def _differs_elsewhere(self, start: Setup) -> bool:
        """Whether a start differs from the last good one in more than the numbers of its law."""
        return replace(self._good[1], **{name: getattr(start, name) for name in OF_LAW[start.law]}) != start

    def _tell(self) -> None:
        """Copies the messages into the scene."""
        if self.scene is not None and dict(self.scene.messages) != self._messages:
            self._put(scene=replace(self.scene, messages=MappingProxyType(dict(self._messages))))
