"""The tab of the three planes: why a tippe top turns over, and that it takes sliding friction."""

import html

import numpy as np
import panel as pn
import panel_material_ui as pmui

from app.cards import PLAIN, TYPE, card, grid, progress, swatch, words
from app.controls import STYLE, Control
from app.keep import Field, Number, OneOf
from app.planes import LAWS, LIFTS, PATIENCE, PLANES, PRESETS, ROLLS
from app.planes_plots import CLOCK, LEDGER, LOOKS, QUANTITIES, REGIMES, STOPPED, Figures, Map, Well, follow_clock
from app.surface3d import pack
from app.top3d import Top3D, pack_frames

SURVIVES = {
    "J": "Jellett <i>J</i>",
    "Routh": "Routh <i>K</i><sub>R</sub>",
    "E": "energy <i>E</i>",
    "L_3": "<i>L</i><sub>3</sub>",
    "L_z": "<i>L</i><sub>z</sub>",
}
EVENTS = {
    "lifts off": "it leaves the table",
    "stem touches": "its stem touches",
    "rim touches": "its rim touches",
    "stands upright": "it stands flat on the end of its stem",
    "too many events": "1000 events (sticks, slips, hops) have passed, and it is followed no further",
}
# Below this a drift is that of the computation; what physics changes changes by more.
ROUNDING = 1e-7
NUMBERS = {"coulomb": ("mu_k", "mu_s"), "viscous": ("gamma",), "smoothed": ("mu", "eps")}
SLOWEST, SHORTEST_SHOW = 1 / 64, 12  # a motion is to play for so many seconds at least
POLL = 200  # ms between looks at a run under way
BUTTON = {
    "size": "small",
    "variant": "outlined",
    "margin": 0,
    "sx": {"textTransform": "none", "whiteSpace": "nowrap", "padding": "2px 8px", "minWidth": 0},
}
FLOW = {"display": "flex", "flex-flow": "row wrap", "gap": "6px"}
# Three bars side by side have room for what matters only.
SMALL_BAR = [":host .bar .shows, :host .bar .view, :host .bar .back, :host .bar .forward { display: none }"]
TABLE = """
table { border-collapse: collapse; margin: 6px 0 0; font-size: inherit }
td, th { padding: 3px 12px 3px 0; text-align: left; font-weight: normal; vertical-align: top }
th { color: var(--faint, #5b6875) } .kept { font-weight: 600 } .kept::before { content: "● "; color: #009E73 }
.line { margin: 2px 0 } .line .swatch { margin-left: 0 } .line b { font-weight: 600 } .says { margin: 6px 0 0 }
"""


def power(value):
    """A small number as 3·10⁻¹³."""
    mantissa, exponent = f"{max(value, 1e-16):.0e}".split("e")
    return f"{mantissa}·10<sup>{int(exponent)}</sup>".replace("-", "−")


def degrees(value):
    return f"{np.degrees(value):.1f}°"


# ---- words ----


def says(**options):
    """Words that change with the picture."""
    return pn.pane.HTML(
        "", stylesheets=[TYPE, STYLE, TABLE], **({"sizing_mode": "stretch_width", "margin": 0} | options)
    )


def law_words(picture):
    """The friction law in force, with its numbers."""
    law, scales = picture.friction, picture.settings.scales
    kind = picture.settings.law
    F_z, F_h = "<i>F</i><sub>z</sub>", "<i>F</i><sub>h</sub>"
    if kind == "coulomb":
        return (f"Coulomb, true stick and slip: slips with {F_h} = {law.mu_k:g} {F_z}, "
                f"rolls while {F_h} ≤ {law.mu_s:g} {F_z}")  # fmt: skip
    if kind == "viscous":
        if not law.gamma:
            return f"none: viscous with <i>γ</i> = 0, {F_h} = 0"
        return (f"viscous: {F_h} = <i>γ</i> {F_z} <i>u</i>, <i>γ</i> = {law.gamma:.4g} (<i>gR</i>)<sup>−½</sup> = "
                f"{law.gamma / scales.velocity:.3g} s/m; it creeps, and never sticks")  # fmt: skip
    return (f"smoothed Coulomb: {F_h} = {law.mu:g} {F_z} <i>u</i>/(<i>u</i>² + <i>ε</i>²)<sup>½</sup>, <i>ε</i> = "
            f"{100 * law.eps * scales.velocity:.2g} cm/s; it creeps, and never sticks")  # fmt: skip


def in_force(picture, plane):
    if plane == "rough":
        return "rough plane: as much static friction as rolling needs"
    if plane == "smooth":
        return "smooth plane: none"
    return law_words(picture)


def happens(event):
    return EVENTS.get(event, f"it {event}")


def fate(picture, plane):
    """What became of the top on a plane, in a phrase."""
    motion = picture.motions[plane]
    if motion is None:
        return html.escape(picture.messages.get(plane, "no such motion"))
    theta, seconds = motion.trajectory.theta, picture.settings.scales.time
    low, high, end, last = theta.min(), theta.max(), theta[-1], motion.trajectory.t[-1] * seconds
    between = f"<i>θ</i> between {degrees(low)} and {degrees(high)}"
    if degrees(low) == degrees(high):
        between = f"<i>θ</i> stays at {degrees(low)}"
    lifts = f" It leaves the table at {last:.2f} s." if motion.ended == "lifts off" else ""
    if plane != "sliding":
        why = ("rolling keeps the sign of <i>ω</i><sub>3</sub>" if plane == "rough"
               else "nothing takes its energy, <i>ω</i><sub>3</sub> stays")  # fmt: skip
        if plane == "rough" and any(which == LIFTS for *_, which in motion.stretches):
            lifts = " (The table would have to pull at times.)"
        return f"<b>never turns over</b>: {why}; {between}.{lifts}"
    verdict, at_the_end = picture.outcome.verdict, f"{degrees(end)} at {last:.3g} s"
    if np.isfinite(motion.overturned):
        word = "swings past 90°" if end < np.pi / 2 else "hangs" if verdict == "hangs" else "turns over"
        said = f"<b>{word}</b>: past 90° at {motion.overturned * seconds:.2f} s, {at_the_end}"
    elif theta[0] < np.pi / 2:
        rises = verdict == "goes upright" and end < theta[0]
        said = f"<b>{'goes upright' if rises else 'does not turn over'}</b>: {at_the_end}"
    else:
        said = f"<b>{'comes upright' if end < np.pi / 2 else 'stays inverted'}</b>: {at_the_end}"
    held = [start for start, _, which in motion.stretches if which == ROLLS]
    if motion.trajectory.regime[-1] == "roll":
        said += f"; caught rolling since {held[-1] * seconds:.2f} s"
    until, event, _ = motion.alone
    if event:
        said += f". At {until * seconds:.2f} s {happens(event)}"
    stop = f" There the computation stops: {happens(motion.ended)}." if motion.ended else ""
    return f"{said}.{stop}"


def verdict_words(picture):
    goes, settings, sliding = picture.outcome, picture.settings, picture.motions["sliding"]
    if settings.law == "viscous" and picture.friction.gamma == 0:
        says = "Without friction no energy goes: it turns for ever as it started."
    else:
        says = f"{html.escape(goes.sentence)} That is where sliding friction takes it"
        caught = sliding is not None and sliding.trajectory.regime[-1] == "roll"
        says += ("; here true stick catches it on the way, and rolling loses nothing: it stays."
                 if caught else ", given time.")  # fmt: skip
    lines = [f'<div class="line">{swatch(LOOKS[plane][0], "")}<b>{plane}</b>: {fate(picture, plane)}</div>'
             for plane in PLANES]  # fmt: skip
    return "".join(lines) + f'<div class="says">{says}</div>'


def table_words(picture):
    """What stays on each plane: the measured drift."""
    head = "".join(f"<th>{swatch(LOOKS[plane][0], plane)}</th>" for plane in PLANES)
    rows = []
    for name, text in SURVIVES.items():
        cells = []
        for plane in PLANES:
            motion = picture.motions[plane]
            cells.append(f"<td>{drift_words(name, motion, picture) if motion else 'no motion'}</td>")
        rows.append(f"<tr><td>{text}</td>{''.join(cells)}</tr>")
    return (f"<table><tr><th>measured drift</th>{head}</tr>{''.join(rows)}</table>"
            '<div class="key">largest difference between two instants, over the largest value</div>')  # fmt: skip


def drift_words(name, motion, picture):
    drift, (until, event, alone) = motion.drift[name], motion.alone
    if drift < ROUNDING:
        return f'<span class="kept">stays to {power(drift)}</span>'
    changes = f"changes by {f'{100 * drift:.3g} %' if drift > 1e-3 else power(drift)}"
    if name == "J" and event and alone < ROUNDING:
        seconds = until * picture.settings.scales.time
        return (f'<span class="kept">stays to {power(alone)}</span> to {seconds:.2f} s, where '
                f"{happens(event)}; in all {changes}")  # fmt: skip
    return changes


def stem_words(settings):
    if settings.shape is None:
        return "<i>a</i>, <i>I</i><sub>1</sub>, <i>I</i><sub>3</sub> are set apart from the body: a whole sphere."
    angle = settings.shape.touch_angle
    if angle is None:
        return "This body has one contact all the way: no stem can touch."
    return f"Past <i>θ</i> = {degrees(angle)} the end of its stem touches the table."


KEPT = {
    "plane": Field("plane", OneOf(**{plane: plane for plane in (*PLANES, "compare")}), undoable=False),
    "by": Field("by", OneOf(spin="spin", constants="constants")),
    "law": Field("law", OneOf(**{law: law for law in LAWS})),
    "landing": Field("land", OneOf(stop="stop", plastic="plastic")),
    "stem": Field("stem", OneOf(yes=True, no=False)),
    **{name: Field(name, Number) for name in ("spin", "tilt", "slip", "seconds", "mu_k", "gamma", "mu", "eps")},
    "mu_s": Field("mu_stick", Number),
}
"""What of a Planes a link keeps."""


class ThreePlanes:
    """main: the tab. planes: the Planes it shows and drives; builder, request: for a top that is picked on the map."""

    def __init__(self, planes, builder, request):
        self._planes, self._request, self._poll = planes, request, None
        self._tops = {
            plane: Top3D(sizing_mode="stretch_both", min_width=250, clock=CLOCK, label=f"The top on the {plane} plane",
                         show_momentum=False, show_cone=False)
            for plane in PLANES
        }  # fmt: skip
        for top in self._tops.values():
            top.param.watch(lambda event: self._set_speed(event.new), "speed")
        self._figures, self._well = Figures(), Well()
        self._map = Map(self.pick, builder.choose)
        follow_clock(self._figures, self._well)
        self._controls = {name: Control(name, getattr(planes, name), self._asked) for name in
                          ("spin", "tilt", "slip", "seconds", "mu_k", "mu_s", "gamma", "mu", "eps")}  # fmt: skip
        self._said = {name: says(margin=(0, 14, 0, 16)) for name in ("law", "stem", "run", "by")}
        self._verdict = says()
        self._force = says(styles={"min-height": "36px"})
        self._table = says()
        self._build()
        planes.param.watch(lambda event: self._show(), "picture")
        planes.param.watch(lambda event: self._look(), "plane")
        planes.param.watch(self._wait, "busy")
        self._arrange()
        if planes.picture is not None:
            self._show()
        self._wait(None)

    # ---- what a person does ----

    def _asked(self, name, value, typed=False):
        self._planes.param.update(**{name: value})

    def pick(self, a, ratio):
        """Goes to the top of this a and I1/I3, with I3 as it is."""
        self._request(a=a, I1=ratio * self._planes.picture.settings.top.I3)

    def _choose(self, name):
        self._planes.choose(name)

    def _set_speed(self, speed):
        for top in self._tops.values():
            top.speed = speed

    # ---- the parts ----

    def _switch(self, name, options, **layout):
        return pmui.RadioButtonGroup.from_param(
            self._planes.param[name], label="", options=options, size="small", sx=PLAIN,
            **({"margin": (2, 14, 6, 16)} | layout),
        )  # fmt: skip

    def _build(self):
        buttons = []
        for name in PRESETS:
            buttons.append(pmui.Button(label=name, name=name, **BUTTON))
            buttons[-1].on_click(lambda event, name=name: self._choose(name))
        presets = pn.Column(*buttons, sizing_mode="stretch_width", margin=(4, 0, 0, 0), styles=FLOW)
        self._row = pn.Column(
            sizing_mode="stretch_width", margin=(6, 0, 0, 0),
            styles={"display": "grid", "gap": "10px"},
            stylesheets=[".scroll-button { display: none !important }"],  # it would take the first place
        )  # fmt: skip
        plane = self._switch(
            "plane", {"rough": "rough", "smooth": "smooth", "sliding": "sliding", "compare all three": "compare"},
            margin=(4, 0),
        )  # fmt: skip
        self._stage = card(
            "One top, one start, three planes", presets, plane, self._force, self._row, self._verdict, self._table,
            height="max-content",
        )  # fmt: skip

        views = {name: control.view for name, control in self._controls.items()}
        self._starts = pn.Column(views["spin"], views["tilt"], views["slip"], sizing_mode="stretch_width", margin=0)
        self._numbers = {
            law: pn.Column(*(views[name] for name in names), sizing_mode="stretch_width", margin=0)
            for law, names in NUMBERS.items()
        }
        self._bar = words(progress(0, "of the motion computed"), margin=(10, 8))
        stop = pmui.Button(label="Stop", name="stop", **BUTTON)
        stop.on_click(lambda event: self._planes.stop())
        self._progress = pn.Row(self._bar, stop, sizing_mode="stretch_width", margin=(0, 14, 0, 16), visible=False)
        self._stem = pmui.Checkbox.from_param(
            self._planes.param.stem, label="the stem’s end can touch", description="", size="small",
            margin=(0, 14, 0, 6),
        )
        landing = {"the motion ends": "stop", "it flies and lands": "plastic"}
        controls = card(
            "The start, and the friction of the sliding plane",
            self._progress,
            self._said["run"],
            self._switch("by", {"spin, tilt and slip": "spin", "as on the tab Roll": "constants"}),
            self._said["by"],
            self._starts,
            views["seconds"],
            self._switch("law", {"Coulomb, sticks": "coulomb", "viscous": "viscous", "smoothed": "smoothed"}),
            self._said["law"],
            *self._numbers.values(),
            words(
                "Where the table would have to pull (<i>F</i><sub>z</sub> = 0); it lands without a bounce:",
                margin=(6, 14, 0, 16),
            ),
            self._switch("landing", landing),
            self._stem,
            self._said["stem"],
            height="max-content",
        )
        well_key = ("The bead is the top; the bar above it is the energy that it has left for nutation. Friction takes "
                    "it down to a minimum (●); at ○ it would balance.")  # fmt: skip
        map_key = ("Across <i>a</i>/<i>R</i>, upwards <i>I</i><sub>1</sub>/<i>I</i><sub>3</sub>. The orange dot is "
                   "this top; click to go elsewhere, or on a known top.")  # fmt: skip
        self._times = self._times_card()
        self.main = grid(
            self._stage,
            controls,
            self._times,
            pn.Column(
                card(
                    "The well <i>V</i><sub>J</sub>(<i>θ</i>), in <i>MgR</i>, over the tilt in degrees",
                    words(f'<div class="key">{well_key}</div>'),
                    pn.pane.Bokeh(self._well.figure, sizing_mode="stretch_both", margin=0),
                    height="370px",
                ),
                card(
                    "Which tops can turn over",
                    words(f'<div class="key">{map_key}</div>'),
                    pn.pane.Bokeh(self._map.figure, sizing_mode="stretch_both", margin=0),
                    height="440px",
                ),
                sizing_mode="stretch_width",
                margin=0,
                styles={"gap": "12px"},
            ),
        )

    def _times_card(self):
        def row(label, figure, height):
            beside = {"width": 50, "sizing_mode": "stretch_height", "margin": (6, 0, 0, 0)}
            return pn.Row(
                words(f'<div class="quantity">{label}</div>', **beside),
                pn.pane.Bokeh(figure, sizing_mode="stretch_both", margin=0),
                sizing_mode="stretch_width",
                height=height,
                margin=0,
            )

        figures = self._figures.figures
        planes = "".join(swatch(colour, text) for colour, text in LOOKS.values())
        ledger = "".join(swatch(colour, name) for name, colour in LEDGER.items())
        regimes = "".join(swatch(colour, name) for colour, name in [*REGIMES.values(), (STOPPED, "ended")])
        return card(
            "The motion over time; click to look at an instant",
            words(f'<div class="key">{planes}</div>'),
            *(row(label, figures[name], 96) for name, label in QUANTITIES.items()),
            words(f'<div class="key" style="margin-top: 6px">Energy, stacked:{ledger}</div>'),
            row("energy<br><i>MgR</i>", figures["ledger"], 190),
            words(f'<div class="key" style="margin-top: 6px">{regimes}</div>'),
            row("", figures["regime"], 56),
            words('<div class="axis"><i>t</i> in s of the real top</div>'),
            height="max-content",
        )

    # ---- what is shown ----

    def _wait(self, _event):
        """A run under way is looked at now and then, and shown where it takes long."""
        if self._planes.busy and self._poll is None:
            self._poll = pn.state.add_periodic_callback(self._look_at_run, period=POLL)
        elif not self._planes.busy and self._poll is not None:
            self._poll.stop()
            self._poll = None
            self._progress.visible = False

    def _look_at_run(self):
        planes = self._planes
        if planes.elapsed > PATIENCE or self._progress.visible:
            self._bar.object = progress(100 * planes.share, "of the motion computed")
            self._progress.visible = True

    def _arrange(self):
        """Which controls there are for this way to start and this law."""
        planes = self._planes
        self._starts.visible = planes.by == "spin"
        for law, numbers in self._numbers.items():
            numbers.visible = planes.law == law

    def _show(self):
        planes, picture = self._planes, self._planes.picture
        settings, messages = picture.settings, picture.messages
        with pn.io.hold():
            self._arrange()
            if not planes.busy:
                for name, control in self._controls.items():
                    value = getattr(planes, name)
                    control.show(value, value, self._note(name, picture), messages.get(name))
            for name, said in self._said.items():
                message = messages.get(name, "")
                text = f'<div class="alert" role="alert">{html.escape(message)}</div>' if message else ""
                said.object = text or {"stem": stem_words(settings), "by": self._start_words(picture)}.get(name, "")
            self._stem.disabled = settings.shape is None or settings.shape.touch_angle is None
            if self._shown is not settings:
                self._figures.show(picture)
                self._map.show(settings.top)
                self._verdict.object = verdict_words(picture)
                self._table.object = table_words(picture)
                self._tempo(settings)
                self._shown = settings
                self._look()

    _shown = _paced = None

    def _tempo(self, settings):
        """A speed at which the motion can be watched, when its length is new."""
        if self._paced != settings.seconds:
            self._paced, speed = settings.seconds, 1.0
            while settings.seconds / speed < SHORTEST_SHOW and speed > SLOWEST:
                speed /= 2
            self._set_speed(speed)

    def _look(self):
        """At the plane, or the planes, that are chosen."""
        picture, plane = self._planes.picture, self._planes.plane
        if picture is None:
            return
        compare = plane == "compare"
        with pn.io.hold():
            self._stage.styles = self._stage.styles | {"grid-column": "1 / -1" if compare else "auto"}
            self._times.styles = self._times.styles | {"grid-row": "span 2" if compare else "auto"}
            columns = "repeat(auto-fit, minmax(min(100%, 280px), 1fr))" if compare else "1fr"
            self._row.styles = self._row.styles | {"grid-template-columns": columns}
            for name, top in self._tops.items():
                top.visible = plane in (name, "compare")
                top.height = 330 if compare else 420
                top.stylesheets = SMALL_BAR if compare else []
                if top.visible:
                    self._show_top(top, picture, name)
            # a picture in 3-D is made when it is first looked at
            row = [top for top in self._tops.values() if top.visible or top in self._row.objects]
            if row != self._row.objects:
                self._row.objects = row
            self._force.object = f"Friction in force: <b>{in_force(picture, plane)}</b>"
            self._table.visible = compare
            self._figures.look(picture, plane)
            self._well.show(picture, plane)

    def _show_top(self, top, picture, plane):
        motion = picture.motions[plane]
        if top.tags == [id(picture.settings)]:
            return
        settings = picture.settings
        top.param.update(
            tags=[id(settings)],
            profile=pack(settings.profile),
            seconds=settings.scales.time,
            a=settings.top.a,
            frames=pack_frames(*motion.frames) if motion else b"",
        )

    def _start_words(self, picture):
        state, scales = picture.state, picture.settings.scales
        if picture.settings.rolling is None:
            return ""
        turns = state.omega3 * scales.angular_velocity / (2 * np.pi)
        return (f'<div class="note">It starts rolling, as the constants chosen there say: <i>θ</i> = '
                f"{degrees(state.theta)}, <i>ω</i><sub>3</sub> = {turns:.2f} rev/s.</div>")  # fmt: skip

    @staticmethod
    def _note(name, picture):
        state, scales, top = picture.state, picture.settings.scales, picture.settings.top
        if name == "spin":
            limits = picture.outcome.thresholds
            unit = scales.angular_velocity / (2 * np.pi)
            holds = {"upright": (limits.upright.stable, limits.upright.spin), "inverted": ("above", limits.launch)}
            says = [f"{pole} is stable {side} {spin * unit:.3g}" for pole, (side, spin) in holds.items()
                    if np.isfinite(spin)]  # fmt: skip
            return "; ".join(says) + (" rev/s" if says else "")
        if name == "slip":
            s, c = np.sin(state.theta), np.cos(state.theta)
            ux = state.vx - (state.omega2 * (c - top.a) - state.omega3 * s)
            uy = state.vy + state.theta_dot * (1 - top.a * c)
            return f"the contact point slips at {100 * scales.velocity * np.hypot(ux, uy):.3g} cm/s"
        if name == "eps":
            return f"{100 * scales.velocity * picture.settings.eps:.3g} cm/s for this top"
        if name == "gamma":
            return f"{picture.settings.gamma / scales.velocity:.3g} s/m for this top"
        return ""
