"""The widgets of the builder: the section with its handles, the dimensions, presets, files, and a measured top."""

import html
import math
from functools import partial

from app.model.build.builder import LARGEST_FILE
from app.model.build.dimensions import FAMILIES, nearest, value_of
from app.model.build.inside import inside
from app.model.runs import Runs
from app.tabs.build.fields import symbol
from app.tabs.build.material import Material
from app.tabs.build.section import Section
from app.text import listed, say, written
from app.widgets.cards import Hidden, alert, flow, note, stack, words
from app.widgets.download import Download
from app.widgets.forms import Button, Choice, Field, Menu, TextFile
from app.widgets.hold import held
from app.widgets.numbers import Numbers, number, tidy
from app.widgets.typeset import typeset
from tippe_core import PRESETS, BareSphere, Lathe, LoadedSphere, TruncatedSphere, Turned

OWN = ""  # because a select cannot show that nothing is chosen


def knob(dimension):
    """The part of a group for one dimension of the body."""
    letter, unit = symbol(dimension.name), dimension.unit
    title = f"{letter} {html.escape(dimension.words)}".strip()
    wording = {"name": dimension.words, "typed": f"{dimension.words}, {unit}".strip(", "), "unit": unit, "html": title}
    return number(dimension.name, wording)


class Pieces:
    """Adds pieces to the body and removes them: hollow and stemmed bodies."""

    # name, initial value
    FIELDS = (("r", "4"), ("from", "0"), ("to", "6"))

    def __init__(self, builder):
        self.builder, self._exact = builder, 0.0
        kinds = {says: kind for kind, says in listed("build.pieces.kinds").items()}
        self.kind = Menu(say("build.pieces.kind"), options=kinds, value="ball")
        spoken = listed("build.pieces.spoken")
        shows = {"r": "<i>r</i>"} | {name: say(f"build.pieces.{name}") for name in ("from", "to")}
        self.entries = {name: Field(spoken[name], value=value, shows=shows[name], size=5)
                        for name, value in self.FIELDS}  # fmt: skip
        self.density = Field(spoken["density"], shows=say("build.pieces.names.density"))
        self.words = words()
        self.put = Button(say("build.pieces.put"), lambda: self._compose(1))
        self.take = Button(say("build.pieces.take"), lambda: self._compose(-1))
        self.undo = Button(say("build.pieces.undo"), builder.take_off)
        self.view = Hidden(lambda: [
            words(note(say("build.pieces.says"))),
            flow(self.kind, *self.entries.values(), self.density),
            flow(self.put, self.take, self.undo),
            self.words])  # fmt: skip

    def show(self, shape):
        self.view.visible, self.density.value = not isinstance(shape, BareSphere), ""
        self.undo.visible = isinstance(shape, Turned) and len(shape.solid.slices) > 1
        if self.view.visible:
            density = getattr(shape, "density", shape.mass / shape.volume)
            # what is removed must be exactly what was added: the number itself, not its displayed digits
            self._exact = density[0] if isinstance(density, tuple) else density
            self.density.value = tidy(self._exact)
        self.words.object = ""

    def _compose(self, sign):
        good, key = dict(self.FIELDS) | {"density": tidy(self._exact)}, "build.pieces.not_a_number"
        try:
            values = {name: entry.number(key, good[name], name=say(f"build.pieces.names.{name}"))
                      for name, entry in (*self.entries.items(), ("density", self.density))}  # fmt: skip
        except ValueError:
            return
        density = self._exact if self.density.value == tidy(self._exact) else values["density"]
        self.builder.compose(self.kind.value, sign * density, *(values[name] / 1e3 for name in self.entries))


class Inside:
    """The choice of what a truncated sphere has inside. choose: called with one of KINDS."""

    def __init__(self, choose):
        options = {says: kind for kind, says in listed("build.inside").items()}
        self.switch = Choice(options, "solid", say("build.bench.inside"))
        self.switch.on("value", lambda event: choose(event.new))
        self.steel = words(note(say("build.bench.steel")), sizing_mode=None)
        self.view = stack(flow(self.switch, self.steel))

    def show(self, shape):
        kind = inside(shape)
        self.switch.put(value=kind or "solid")
        self.view.visible, self.steel.visible = bool(kind), kind in ("disc", "both")


class Build:
    """The builder's cards. builder: a Builder; runs: the page's Runs. show() is for each scene of a hand at rest."""

    def __init__(self, builder, runs=None):
        runs = runs or Runs()
        self.builder, self._tried = builder, {}  # the last requested value of a dimension, in its unit
        self._dimensions, self._shown = {}, None
        self.section = Section(self._drag, self._tapped_twice)
        self.numbers, self.derived, self.file_words = words(), words(), words()
        self.source = words()
        self.families = Menu(say("build.bench.family"))
        self.families.on("value", lambda event: event.new and builder.choose_family(event.new))
        self.material = Material(lambda density: builder.set("density", density))
        self.inside = Inside(builder.fill)
        self.dimensions = Numbers([], self._pull, margin=(6, 0))
        self.parting = self._button("parts", builder.part_densities)
        self.points = Hidden(lambda: [words(note(say("build.bench.twice"))), flow(
            self._button("add", builder.add_point), self._button("remove", self._remove), self.parting)])  # fmt: skip
        self.pieces = Pieces(builder)
        self.stl = Download(runs, lambda: (builder.stl() or b"",), bytes, label=say("build.bench.stl"),
                            filename="top.stl", margin=0)  # fmt: skip
        self.saved = Download(runs, lambda: (builder.save(),), str.encode, label=say("build.bench.save"),
                              filename="top.json", margin=0)  # fmt: skip
        self.file = TextFile(say("build.bench.load"), builder.load, partial(builder.refuse_file, LARGEST_FILE),
                             accept=".json", most=LARGEST_FILE)  # fmt: skip
        self.back = self._button("back", builder.attach)
        self.parted = Hidden(lambda: [words(f'<div class="alert">{say("build.bench.parted")}</div>'), self.back])
        builder.param.watch(lambda event: self._show(event.new), "draft")
        self._show(builder.draft)

    def _drag(self, name, value):
        self._tried = {}
        self.builder.set(name, value)

    def _pull(self, name, value, typed):
        """A request for a dimension, in its unit."""
        self._tried = {name: value}
        self.builder.set(name, value / self._dimensions[name].factor)

    @staticmethod
    def _button(key, click):
        return Button(say(f"build.bench.{key}"), click)

    def _remove(self):
        last = len(self.builder.draft.shape.points) - 1
        held, self.section.last_point = self.section.last_point, None
        self.builder.remove_point(last if held is None else min(held, last))

    def _tapped_twice(self, name, x, z):
        """On a point of a free profile: removes it; elsewhere: adds one."""
        if isinstance(self.builder.draft.shape, Lathe):
            if name.startswith("point "):
                self.builder.remove_point(int(name[6:]))
            elif not name:
                self.builder.add_point(x, z)

    @property
    def section_view(self):
        """What kind of body, its section, the results, and whether the explorer's numbers are still those of the
        body."""
        kinds = flow(self.families, self.material.view)
        return [kinds, self.section.view, self.numbers, self.derived, self.parted]

    @property
    def bench_view(self):
        """The inputs."""
        return [self.inside.view, self.dimensions.view, self.points, self.pieces.view,
                flow(self.saved, self.file, self.stl), self.file_words, self.source]  # fmt: skip

    def _show(self, draft):
        with held():
            self._show_fields(draft)
            elsewhere = {"measured", *self._dimensions}
            wording = [text for name, text in draft.messages.items() if name not in elsewhere]
            self.file_words.object = alert(wording[0] if wording else "")
            if draft.messages:
                return
            self.section.show(draft)
            self.numbers.object, self.derived.object = numbers_words(draft.shape), derived_words(draft.shape)
            self.source.object = note(html.escape(draft.source))

    def _show_fields(self, draft):
        now = [draft.family, *((dimension.name, dimension.words) for dimension in draft.dimensions)]
        if now != self._shown:
            self._shown, self._dimensions = now, {each.name: each for each in draft.dimensions}
            self.dimensions.lay_out([knob(each) for each in draft.dimensions])
        free = isinstance(draft.shape, Lathe)
        self.points.visible = free
        if free:
            self.parting.label = say(f"build.bench.{'one' if isinstance(draft.shape.density, tuple) else 'parts'}")
        self.pieces.show(draft.shape)
        self.inside.show(draft.shape)
        self.material.show(draft.shape)
        self._show_dimensions(draft)
        called = listed("build.families")  # the chosen one cannot be chosen again: a changed body has its own
        own = {} if draft.name else {say("build.bench.changed", family=called[draft.family]): OWN}
        families = {called[family]: family for family, _ in (FAMILIES[type(preset.shape)] for preset in PRESETS)}
        self.families.put(options=own | families, value=draft.family if draft.name else OWN)
        self.stl.disabled = isinstance(draft.shape, BareSphere)

    def _show_dimensions(self, draft):
        dimensions, shape = self._dimensions, draft.shape
        values = {name: float(f"{value_of(shape, name) * each.factor:.9g}") for name, each in dimensions.items()}
        tracks = {name: (min(each.low, values[name]), max(each.high, values[name]), each.step, None)
                  for name, each in dimensions.items()}  # fmt: skip
        wrong = {name: typeset(wording) for name, wording in draft.messages.items() if name in dimensions}
        tried = {name: value for name, value in self._tried.items() if name in wrong}
        for name, value in tried.items():
            if draft.about != name.partition(" ")[0]:  # another cannot be any more: said where the hand was
                wrong[name] = say("build.bench.with_it", value=tidy(value), name=dimensions[name].words,
                                  unit=dimensions[name].unit, why=wrong[name])  # fmt: skip
        near = {name: nearest(shape, dimensions[name], value) for name, value in tried.items()}
        self.dimensions.show(values, tracks, messages=wrong, refused=tried,
                             nearest={name: value for name, value in near.items() if value is not None})  # fmt: skip

    def show(self, scene):
        """Says whether the scene's numbers are those of the body."""
        self.parted.visible = scene.shape is None


def numbers_words(shape):
    """The numbers that decide how a body moves."""
    top = shape.top
    rows = [
        ("<i>a</i>/<i>R</i>", f"= {written(top.a, '.4f')}"),
        ("<i>I</i><sub>1</sub>", f"= {written(top.I1, '.4f')} <i>MR</i><sup>2</sup>"),
        ("<i>I</i><sub>3</sub>", f"= {written(top.I3, '.4f')} <i>MR</i><sup>2</sup>"),
        (say("build.body.mass"), f"{written(1e3 * shape.mass, '.4g')} g"),
    ]
    if not isinstance(shape, BareSphere):
        # one number if it is of one material, else the mean
        rows.append((say("build.body.density"), f"{shape.mass / shape.volume:.0f} kg/m³"))
    return "&emsp;".join(f'<span style="white-space: nowrap">{name} {value}</span>' for name, value in rows)


def derived_words(shape):
    """When its stem touches the table, and what can be printed of it."""
    angle = shape.touch_angle
    touch = say("build.body.never") if angle is None else say("build.body.touches", angle=math.degrees(angle))
    prints = "unknown" if isinstance(shape, BareSphere) else ""
    if isinstance(shape, LoadedSphere) and shape.core_density:  # unless the core is a cavity
        prints = "outside"
    if isinstance(shape, TruncatedSphere) and shape.disc:
        prints = "outside_disc"
    return f"<div>{touch}{say(f'build.body.{prints}') if prints else ''}</div>"
