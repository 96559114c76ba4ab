"""The builder's widgets: the section with its handles, the dimensions, presets, files, and a measured top."""

import html
import io
import math
from functools import partial

import numpy as np
import panel as pn
import panel_material_ui as pmui
import param
from bokeh.models import ColumnDataSource, CustomJS, HoverTool, Range1d

from app.model.bodies import body
from app.model.builder import LARGEST_FILE, Rocking
from app.model.colours import COLOURS, FAINT, INK
from app.model.dimensions import FAMILIES, handles, named, pulled, sentence, value_of
from app.state import asked
from app.text import listed, say
from app.widgets.cards import BUTTON, alert, beside, field, flow, note, on_click, words
from app.widgets.controls import Dial, asked_of, number, typed_number, wording
from app.widgets.pacing import at_once
from app.widgets.plots import plain
from tippe_core import PRESETS, BareSphere, Lathe, LoadedSphere, TopError, Turned

SYMBOLS = {"r1": "<i>r</i><sub>1</sub>", "r2": "<i>r</i><sub>2</sub>", "I1": "<i>I</i><sub>1</sub>",
           "I3": "<i>I</i><sub>3</sub>", "density": "<i>ρ</i>", "core_density": "<i>ρ</i><sub>core</sub>"}  # fmt: skip
PARTS = {"body": "#d9b98c", "hollow": "white", "core": "#8a96a3"}  # of the section, in the order they are drawn
FRAME = 276  # px; square, so that both axes have one scale
REACH = 16  # px from a handle that still take hold of it
KNOBS = 32  # made at a time
OWN = ""  # a select has no way to show that nothing is chosen
# Where a hand goes down: a quick one is elsewhere by the time it counts as dragging.
PRESS = """
if (pressed.followed) return
pressed.followed = true
const {canvas_view: {events_el}, frame: {x_scale, y_scale}} = Bokeh.index.find_one(fig)
const press = ({offsetX, offsetY}) => { pressed.data = {x: [x_scale.invert(offsetX)], z: [y_scale.invert(offsetY)]} }
events_el.addEventListener("pointerdown", press, {capture: true})
"""


def symbol(name):
    if name.startswith("density "):
        return SYMBOLS["density"]
    return SYMBOLS.get(name, f"<i>{name}</i>")


def grid(*content):
    """Side by side where there is room."""
    return pn.Column(
        *content, sizing_mode="stretch_width", margin=(6, 0),
        styles={"display": "grid", "grid-template-columns": "repeat(auto-fit, minmax(min(100%, 215px), 1fr))",
                "column-gap": "22px"},
    )  # fmt: skip


class Section:
    """The cut through axis 3, to scale in mm, with handles. pull: what takes (dimension, value in SI) from a hand."""

    def __init__(self, pull):
        self._pull, self._held, self._shape, self._span = pull, None, None, 0.0
        self.last_point = None  # index of the point of a Lathe that was held last
        self.figure = fig = plain(x_range=Range1d(-1, 1), y_range=Range1d(-1, 1), name="section")
        fig.update(sizing_mode=None, width=FRAME + 50, height=FRAME + 30, frame_width=FRAME, frame_height=FRAME)
        fig.xaxis.ticker.desired_num_ticks = fig.yaxis.ticker.desired_num_ticks = 5
        # A patch each: of patches Bokeh 3.10 may draw as many as there were before.
        self.parts = {part: ColumnDataSource({"x": [], "z": []}) for part in PARTS}
        self.lines = ColumnDataSource({"x": [], "z": [], "colour": [], "dash": [], "width": []})
        self.points = ColumnDataSource({"x": [], "z": [], "colour": []})
        self.letters = ColumnDataSource({"x": [], "z": [], "text": [], "dx": [], "dy": [], "style": []})
        self.handles = ColumnDataSource({"x": [], "z": [], "name": [], "says": []})
        for part, colour in PARTS.items():
            fig.patch("x", "z", source=self.parts[part], fill_color=colour, line_color=INK, line_width=1.5)
        fig.multi_line("x", "z", source=self.lines, line_color="colour", line_dash="dash", line_width="width")
        fig.scatter("x", "z", source=self.points, size=7, color="colour")
        fig.text("x", "z", text="text", source=self.letters, x_offset="dx", y_offset="dy", text_color=INK,
                 text_font_size="15px", text_font_style="style", text_font={"value": "Georgia, serif"},
                 text_align="center", text_baseline="middle")  # fmt: skip
        knobs = fig.scatter("x", "z", source=self.handles, size=14, fill_color="white", line_color=COLOURS["theta"],
                            line_width=3)  # fmt: skip
        fig.add_tools(HoverTool(renderers=[knobs], tooltips="@says", point_policy="snap_to_data"))
        self.pressed = ColumnDataSource({"x": [], "z": []})
        fig.js_on_change("inner_width", CustomJS(args={"fig": fig, "pressed": self.pressed}, code=PRESS))
        fig.on_event("panstart", self._take)
        fig.on_event("pan", self._drag)
        fig.on_event("panend", self._let_go)

    def _take(self, event):
        pressed = self.pressed.data
        self._held = self.handle_at(pressed["x"][0], pressed["z"][0]) if len(pressed["x"]) else None
        if self._held and self._held.startswith("point "):
            self.last_point = int(self._held[6:])

    def handle_at(self, x, y):
        """The name of the handle that a hand at (x, y) in mm takes hold of, or None."""
        places = {name: np.hypot(1e3 * across - x, 1e3 * z - y) for name, (across, z) in handles(self._shape).items()}
        nearest = min(places, key=places.get, default=None)
        return nearest if places and places[nearest] < REACH * self._span / FRAME else None

    def _drag(self, event):
        if self._held:
            self._pull(self._held, pulled(self._shape, self._held, event.x / 1e3, event.y / 1e3))

    def _let_go(self, event):
        if self._held:
            self._held = None
            self._frame()

    def show(self, draft):
        shape = self._shape = draft.shape
        profile = 1e3 * shape.R * body(shape)
        R, height = 1e3 * shape.R, 1e3 * shape.com
        if not self._held:
            self._frame()
        span = self._span
        parts = {"body": [profile], "hollow": [1e3 * rows for rows in _cavities(shape)], "core": []}
        turn = np.linspace(0, np.pi, 37)
        if isinstance(shape, LoadedSphere):
            core = np.column_stack([shape.b * np.sin(turn), shape.b * np.cos(turn) - shape.d])
            parts["core" if shape.core_density else "hollow"].append(1e3 * core)
        for part, outlines in parts.items():
            x, z = _closed(outlines)
            self.parts[part].data = {"x": x, "z": z}
        low, high = min(-R, profile[:, 1].min()), profile[:, 1].max()
        wide = profile[:, 0].max()
        aside = wide + 0.05 * span
        straight = [
            ((-span, span), (-R, -R), INK, [], 2),
            ((0, 0), (low, high + 0.06 * span), FAINT, [8, 4], 1.5),
            ((-wide - 0.03 * span, wide + 0.03 * span), (height, height), FAINT, [8, 4], 1.5),
            ((0, -R * 0.8), (0, -R * 0.6), COLOURS["normal"], [], 2),
            ((aside, aside), (0, height), COLOURS["friction"], [], 3),
            ((0, aside), (0, 0), COLOURS["friction"], [2, 3], 1),
            ((0, aside), (height, height), COLOURS["friction"], [2, 3], 1),
        ]
        sphere = (R * np.sin(2 * turn), R * np.cos(2 * turn), FAINT, [2, 4], 1)
        x, z, colour, dash, thick = zip(sphere, *straight, strict=True)
        self.lines.data = {"x": list(x), "z": list(z), "colour": colour, "dash": list(dash), "width": thick}
        self.points.data = {"x": [0, 0, 0], "z": [0, height, -R], "colour": [INK, COLOURS["friction"], INK]}
        letters = [
            (0, 0, "O", -12, -10, "italic"), (0, height, "G", 14, 10 if height <= 0 else -10, "italic"),
            (0, -R, "C", 0, 14, "italic"), (-0.4 * R, -0.3 * R, "R", -8 if R > span / 12 else -26, -8, "italic"),
            (aside, height / 2, "a", 10, 0, "italic"), (0, high + 0.06 * span, "3", 0, -10, "normal"),
            (-wide - 0.03 * span, height, "1", -10, 0, "normal"),
        ]  # fmt: skip
        self.letters.data = dict(zip(("x", "z", "text", "dx", "dy", "style"), zip(*letters, strict=True), strict=True))
        said = {dimension.name: dimension for dimension in draft.dimensions}
        at = handles(shape)
        self.handles.data = {
            "x": [1e3 * x for x, _ in at.values()],
            "z": [1e3 * z for _, z in at.values()],
            "name": list(at),
            "says": [f"{said[name].words}: {number(value_of(shape, name) * said[name].factor)} {said[name].unit}"
                     if name in said else say("workshop.bench.point", x=number(1e3 * x), z=number(1e3 * z))
                     for name, (x, z) in at.items()],
        }  # fmt: skip

    def _frame(self):
        """All of the body in view; in coarse steps, so that it does not swim."""
        profile = 1e3 * self._shape.R * body(self._shape)
        low, high = profile[:, 1].min(), profile[:, 1].max()
        needed = 1.3 * max(2 * profile[:, 0].max(), high - low)
        self._span = span = 1.25 ** math.ceil(math.log(needed, 1.25))
        middle = (low + high) / 2
        for axis, centre in ((self.figure.x_range, 0.0), (self.figure.y_range, middle)):
            axis.update(start=centre - span / 2, end=centre + span / 2)


def _closed(outlines):
    """x and z of a Patch of outlines (k, 2) of bodies of revolution, gaps between them."""
    rows = [np.vstack([half, half[::-1] * (-1, 1), [[np.nan, np.nan]]]) for half in outlines]
    return np.vstack(rows)[:-1].T if rows else np.empty((2, 0))


def _cavities(shape):
    """Closed outlines inside the body, (k, 2) m."""
    if not isinstance(shape, Turned):
        return []
    return [np.vstack([edge.points(24) for edge in outline]) for outline in shape.solid.outlines[1:]]


class Knob:
    """One dimension of the body: a Dial. pull: a function of its name and the value that is wanted, in SI."""

    def __init__(self, dimension, pull):
        self.dimension, self._pull, self._heard = dimension, pull, 0
        name, spoken = dimension.name, f"{dimension.words}, {dimension.unit}".strip(", ")
        self.view = Dial(
            input=name, title=f'{symbol(name)}&ensp;<span class="note">{spoken}</span>', spoken=dimension.words,
            unit=dimension.unit, step=dimension.step, start=dimension.low, end=dimension.high,
            sizing_mode="stretch_width", margin=(0, 6, 8, 6),
        )  # fmt: skip
        at_once(self.view, "asked")
        self.view.param.watch(asked.heard(self._asked), "asked")

    def _asked(self, event):
        self._heard, value, typed = asked_of(event.new)
        if typed:
            try:
                value = typed_number(value)
            except ValueError:
                self.say(say("workshop.bench.not_a_number", text=value, number=self.dimension.high))
                return
        self._pull(self.dimension.name, value / self.dimension.factor)

    def show(self, shape):
        value = float(f"{value_of(shape, self.dimension.name) * self.dimension.factor:.9g}")
        self.view.param.update(told=[self._heard, value, number(value)], **wording(""))

    def say(self, text):
        self.view.param.update(**wording(text, wrong=True))


class Pieces:
    """Putting pieces on the body and taking them away: hollow and stemmed bodies."""

    # name, what stands there at first
    FIELDS = (("r", "4"), ("from", "0"), ("to", "6"))

    def __init__(self, builder):
        self.builder, self._exact = builder, 0.0
        kinds = {says: kind for kind, says in listed("workshop.pieces.kinds").items()}
        self.kind = pmui.Select(label=say("workshop.pieces.kind"), options=kinds, value="ball", size="small",
                                width=120, margin=(8, 0, 0, 0))  # fmt: skip
        spoken = listed("workshop.pieces.spoken")
        self.entries = {name: field(value, spoken[name], width=58) for name, value in self.FIELDS}
        self.density = field("", spoken["density"], width=78)
        self.words = words()
        self.put, self.take, self.undo = (
            pmui.Button(label=say(f"workshop.pieces.{does}"), **BUTTON) for does in ("put", "take", "undo")
        )
        on_click(self.put, lambda event: self._compose(1))
        on_click(self.take, lambda event: self._compose(-1))
        on_click(self.undo, lambda event: builder.take_off())
        self._view = pn.Column(
            words(note(say("workshop.pieces.says"))),
            flow(self.kind, beside("<i>r</i>", self.entries["r"]),
                 *(beside(say(f"workshop.pieces.{name}"), self.entries[name]) for name in ("from", "to")),
                 beside("<i>ρ</i>", self.density),
                 self.put, self.take, self.undo),
            self.words, sizing_mode="stretch_width", margin=0)  # fmt: skip

    @property
    def view(self):
        return [self._view]

    def show(self, shape):
        self._view.visible = not isinstance(shape, BareSphere)
        self.undo.visible = isinstance(shape, Turned) and len(shape.solid.slices) > 1
        if self._view.visible:
            density = getattr(shape, "density", shape.mass / shape.volume)
            # what is taken away has to be all there is: the number itself, not the digits shown
            self._exact = density[0] if isinstance(density, tuple) else density
            self.density.value = number(self._exact)
        self.words.object = ""

    def _compose(self, sign):
        values = {}
        for name, entry in (*self.entries.items(), ("density", self.density)):
            try:
                values[name] = typed_number(entry.value)
            except ValueError:
                which = say(f"workshop.pieces.names.{name}")
                self.words.object = alert(say("workshop.pieces.not_a_number", name=which, text=entry.value))
                return
        density = self._exact if self.density.value == number(self._exact) else values["density"]
        self.builder.compose(self.kind.value, sign * density, *(values[name] / 1e3 for name in self.entries))


class TopFile(pmui.FileInput):
    """Counts the files that were refused because they are too large; the base class has no word for them, and takes as
    many as are sent, of any size. Of this one's each comes whole."""

    refused = param.Integer(default=0)
    _sent = None  # until the browser says that this is all

    def _handle_msg(self, msg):
        status = msg["status"]
        if status == "upload_event":
            self._sent = msg
        elif status == "finished" and self._sent:
            sent, self._sent = self._sent, None
            if isinstance(sent["data"], bytes | memoryview) and len(sent["data"]) <= LARGEST_FILE:
                self.param.update(value=bytes(sent["data"]), filename=sent["name"], mime_type=sent["mime_type"])
            else:
                self.refused += 1
            self._send_msg({"status": "finished"})
        elif status == "error":
            self.refused += 1


class Workshop:
    """The builder's cards. soon: of a Pacer; a body of many pieces has its knobs in portions, others' work between."""

    def __init__(self, builder, explorer, soon=lambda make: make()):
        self.builder, self._soon = builder, soon
        self._knobs, self._shown, self._silent = {}, None, False
        self.section = Section(builder.set)
        self.derived, self.source, self.file_words = words(), words(), words()
        self.presets = self._choice("presets", builder.choose)
        self.families = self._choice("family", builder.choose_family)
        self.dimensions = pn.Column(sizing_mode="stretch_width", margin=0)
        self.section.figure.on_event("doubletap", self._tapped_twice)
        self.parting = self._button("parts", lambda event: builder.part_densities())
        buttons = flow(self._button("add", lambda event: builder.add_point()), self._button("remove", self._remove),
                       self.parting)  # fmt: skip
        self.points = pn.Column(words(note(say("workshop.bench.twice"))), buttons, sizing_mode="stretch_width",
                                margin=0)  # fmt: skip
        self.pieces = Pieces(builder)
        self.stl = self._download("stl", "top.stl", lambda: builder.stl() or b"")
        self.saved = self._download("save", "top.json", lambda: builder.save().encode())
        self.file = TopFile(label=say("workshop.bench.load"), accept=".json", multiple=False,
                            max_file_size=LARGEST_FILE, **BUTTON)  # fmt: skip
        self.file.param.watch(self._loaded, "value", onlychanged=False)
        self.file.param.watch(lambda event: builder.refuse_file(LARGEST_FILE), "refused")
        self.back = self._button("back", lambda event: builder.attach())
        self.parted = pn.Column(
            words(f'<div class="alert">{say("workshop.bench.parted")}</div>'), self.back,
            visible=False, sizing_mode="stretch_width", margin=0)  # fmt: skip
        builder.param.watch(lambda event: self._show(event.new), "draft")
        self._show(builder.draft)

    def _choice(self, key, choose):
        select = pmui.Select(label=say(f"workshop.bench.{key}"), options={}, value=None, size="small",
                             margin=(10, 6, 4, 0), sizing_mode="stretch_width")  # fmt: skip
        select.param.watch(lambda event: None if self._silent or not event.new else choose(event.new), "value")
        return select

    @staticmethod
    def _button(key, click):
        button = pmui.Button(label=say(f"workshop.bench.{key}"), **BUTTON)
        on_click(button, click)
        return button

    def _remove(self, event):
        last = len(self.builder.draft.shape.points) - 1
        held, self.section.last_point = self.section.last_point, None
        self.builder.remove_point(last if held is None else min(held, last))

    def _tapped_twice(self, event):
        """On a point of a free profile: takes it away; elsewhere: adds one."""
        if isinstance(self.builder.draft.shape, Lathe):
            name = self.section.handle_at(event.x, event.y) or ""
            if name.startswith("point "):
                self.builder.remove_point(int(name[6:]))
            elif not name:
                self.builder.add_point(event.x / 1e3, event.y / 1e3)

    @staticmethod
    def _download(key, filename, content):
        return pmui.FileDownload(label=say(f"workshop.bench.{key}"), filename=filename,
                                 callback=lambda: io.BytesIO(content()), **BUTTON)  # fmt: skip

    @property
    def section_view(self):
        """The section, what follows from it, and whether the explorer's numbers are still its own."""
        return [pn.pane.Bokeh(self.section.figure, margin=0), self.derived, self.parted]

    @property
    def bench_view(self):
        """What a person sets."""
        files = flow(self.saved, self.file, self.stl)
        choices = grid(self.presets, self.families)
        return [choices, self.source, self.dimensions, self.points, *self.pieces.view, files, self.file_words]

    def _loaded(self, event):
        if event.new:
            self.builder.load(event.new)

    def _show(self, draft):
        with pn.io.hold():
            self._show_fields(draft)
            elsewhere = {"measured", *self._knobs}
            said = [text for name, text in draft.messages.items() if name not in elsewhere]
            self.file_words.object = alert(said[0] if said else "")
            if draft.messages:
                return
            self.section.show(draft)
            self.derived.object = derived_words(draft.shape)
            self.source.object = note(html.escape(draft.source))

    def _show_fields(self, draft):
        now = [draft.family, *((dimension.name, dimension.words) for dimension in draft.dimensions)]
        if now != self._shown:
            self._shown = now
            self._knobs, self.dimensions.objects = {}, []
            self._add_knobs(now)
        free = isinstance(draft.shape, Lathe)
        self.points.visible = free
        if free:
            self.parting.label = say(f"workshop.bench.{'one' if isinstance(draft.shape.density, tuple) else 'parts'}")
        self.pieces.show(draft.shape)
        for name, knob in self._knobs.items():
            if name in draft.messages:
                knob.say(draft.messages[name])
            elif not draft.messages:
                knob.show(draft.shape)
        self._silent = True
        # what is chosen already cannot be chosen: a changed body has an entry of its own, beside those to go back to
        own = {} if draft.name else {say("workshop.bench.none"): OWN}
        presets = {named(preset.name): preset.name for preset in PRESETS}
        self.presets.param.update(options=own | presets, value=draft.name)
        called = listed("workshop.families")
        own = {} if draft.name else {say("workshop.bench.changed", family=called[draft.family]): OWN}
        families = {called[family]: family for family, _ in (FAMILIES[type(preset.shape)] for preset in PRESETS)}
        self.families.param.update(options=own | families, value=draft.family if draft.name else OWN)
        self._silent = False
        self.stl.disabled = isinstance(draft.shape, BareSphere)

    def _add_knobs(self, shown):
        """The next KNOBS of them, unless others are shown by now."""
        draft = self.builder.draft
        more = draft.dimensions[len(self._knobs) :]
        if shown is not self._shown or not more:
            return
        added = {dimension.name: Knob(dimension, self.builder.set) for dimension in more[:KNOBS]}
        self._knobs |= added
        for knob in added.values():
            knob.show(draft.shape)
        self.dimensions.append(grid(*(knob.view for knob in added.values())))
        if len(more) > KNOBS:
            self._soon(partial(self._add_knobs, shown))

    def show_scene(self, scene):
        """Whether the explorer's numbers are the body's."""
        self.parted.visible = scene.shape is None


def derived_words(shape):
    top, angle = shape.top, shape.touch_angle
    rows = [
        ("<i>a</i>/<i>R</i>", f"= {top.a:.4f}".replace("-", "−")),
        ("<i>I</i><sub>1</sub>", f"= {top.I1:.4f} <i>MR</i><sup>2</sup>"),
        ("<i>I</i><sub>3</sub>", f"= {top.I3:.4f} <i>MR</i><sup>2</sup>"),
        (say("workshop.body.mass"), f"{1e3 * shape.mass:.4g} g"),
    ]
    if not isinstance(shape, BareSphere):
        # one number where it is of one material, else the mean
        rows.append((say("workshop.body.density"), f"{shape.mass / shape.volume:.0f} kg/m³"))
    numbers = "&emsp;".join(f'<span style="white-space: nowrap">{name} {value}</span>' for name, value in rows)
    touch = say("workshop.body.never") if angle is None else say("workshop.body.touches", angle=math.degrees(angle))
    prints = "unknown" if isinstance(shape, BareSphere) else ""
    if isinstance(shape, LoadedSphere) and shape.core_density:  # a cavity is in it
        prints = "outside"
    return f"<div>{numbers}</div><div>{touch}{say(f'workshop.body.{prints}') if prints else ''}</div>"


class Measure:
    """A top of one's own: mass, diameter and the period of small rocking at rest -> a/R."""

    # name, what stands there at first, and SI in one of the unit
    FIELDS = (("D", "32.0", 1e-3), ("dD", "0.1", 1e-3), ("T", "1.08", 1.0), ("dT", "0.01", 1.0), ("M", "11.5", 1e-3))

    def __init__(self, builder):
        self.builder = builder
        spoken = listed("workshop.own.spoken")
        self.entries = {name: field(value, spoken[name]) for name, value, _ in self.FIELDS}
        self.result = words()
        self.use = pmui.Button(label=say("workshop.own.explore"), **BUTTON | {"margin": (4, 0)})
        on_click(self.use, self._use)
        for entry in self.entries.values():
            entry.param.watch(lambda event: self._show(), "value")
        builder.param.watch(lambda event: self._show(), "draft")
        self._show()

    @property
    def view(self):
        """Fields, formula, answer."""
        fields = [
            pn.Row(words(note(says), margin=(5, 6, 0, 0)), self.entries[name], sizing_mode="stretch_width",
                   margin=(2, 0))
            for name, says in listed("workshop.own.fields").items()]  # fmt: skip
        return [words(say("workshop.own.says")), grid(*fields), self.result, self.use]

    def _found(self):
        """(Rocking, Measured); raises TopError, ValueError."""
        values = {}
        for name, _, unit in self.FIELDS:
            entry = self.entries[name]
            try:
                values[name] = typed_number(entry.value) * unit
            except ValueError:
                raise ValueError(say("workshop.own.not_a_number", text=entry.value)) from None
        rocking = Rocking(**values)
        return rocking, rocking.a(self.builder.draft.shape)

    def _show(self):
        said = self.builder.draft.messages.get("measured")
        if self.builder.draft.shape.top.a < 0:
            self.result.object = note(say("workshop.own.cannot"))
            self.use.disabled = True
            return
        try:
            rocking, found = self._found()
        except ValueError as error:
            self.result.object = alert(sentence(error) if isinstance(error, TopError) else str(error))
            self.use.disabled = True
            return
        self.use.disabled = False
        self.result.object = alert(said) or say(
            "workshop.own.found", a=found.value, uncertainty=found.uncertainty, period=found.shares["T"],
            diameter=found.shares["R"], below=found.value * rocking.D / 2 * 1e3,
            I1=self.builder.draft.shape.top.I1)  # fmt: skip

    def _use(self, event):
        rocking, found = self._found()
        self.builder.measured(M=rocking.M, R=rocking.D / 2, a=found.value)
