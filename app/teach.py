"""For teachers: links, plans, what goes wrong, the Olympiad's problem, the toy, and a vote; and the student's page."""

import re
import secrets
from itertools import pairwise
from urllib.parse import quote

import numpy as np
import panel as pn
import panel_material_ui as pmui
import segno
from bokeh.models import ColumnDataSource, FactorRange, Range1d

from app import lesson
from app.cards import PLAIN, alert, card, grid, note, on_click, px, words
from app.classroom import MOST_VOTES, ROOMS, Refused
from app.colours import COLOURS
from app.keep import EXPLORER
from app.plots import plain
from app.runs import Run
from app.text import listed, say, told
from tippe_core import Top, TopError

BINS = 12
LOOK_EVERY = 500  # ms
QR_MODULE = 4


def option(step, key):
    """The words of an option; some steps have their own for the same key."""
    return listed("learn.options").get(step.name, {}).get(key) or say(f"learn.options.{key}")


def unit(asks):
    """Of a Guess, as it is written here."""
    return listed("learn.units").get(asks.unit, asks.unit)


def link(step):
    """The query that opens a step with its motion set up, for the paper's top."""
    texts = {"tab": "learn", "step": step.name} | {
        EXPLORER[name].key: EXPLORER[name].codec.text(value)
        for name, value in step.inputs(Top.paper()).items()
    }  # fmt: skip
    return "?" + "&".join(f"{key}={quote(text)}" for key, text in texts.items())


def bullets(items, ordered=False):
    kind = "ol" if ordered else "ul"
    return f"<{kind} style='margin: 4px 0; padding-left: 20px'>{''.join(f'<li>{item}</li>' for item in items)}</{kind}>"


def prediction(step, asks, value=None):
    """The widget for what a step asks, a Choice or a Guess."""
    label = say("learn.page.yours")
    if isinstance(asks, lesson.Choice):
        options = {option(step, key): key for key in asks.options}
        group = pmui.RadioBoxGroup(label=label, options=options, value=value, inline=False, margin=(4, 0))
        group._allows_none = True  # else it takes the first by itself, when made and again, unseen, when drawn
        group.value = value
        return group
    start = min(max(value, asks.low), asks.high) if value is not None else (asks.low + asks.high) / 2
    return pmui.FloatSlider(label=f"{label}, {unit(asks)}" if asks.unit else label, start=asks.low, end=asks.high,
                            step=asks.step, value=start, sizing_mode="stretch_width", margin=(4, 12),
                            size="small")  # fmt: skip


def page_address():
    """Of this page, without a query."""
    location = pn.state.location
    return f"{location.protocol}//{location.hostname}{f':{location.port}' if location.port else ''}{location.pathname}"


class Vote:
    """The teacher's side of a vote: opens a room about a step on the present top, and shows its histogram."""

    def __init__(self, explorer, runs):
        self._explorer, self._runs, self._room, self._finding = explorer, runs, None, None
        self._callback = self._shown = None
        titles = {f"{i}. {say(f'learn.{name}.title')}": name for i, name in enumerate(lesson.NAMES, 1)}
        self.which = pmui.Select(label=say("teach.vote.which"), options=titles, value=lesson.NAMES[0], size="small",
                                 sizing_mode="stretch_width")  # fmt: skip
        self.open = pmui.Button(label=say("teach.vote.open"), variant="contained", size="small", sx=PLAIN)
        self.close = pmui.Button(label=say("teach.vote.close"), variant="outlined", size="small", sx=PLAIN,
                                 visible=False)  # fmt: skip
        self.answer = pmui.Button(label=say("teach.vote.answer"), variant="outlined", size="small", sx=PLAIN,
                                  visible=False)  # fmt: skip
        self.address, self.count, self.truth = words(""), words(say("teach.vote.shut")), words("")
        self.bars = ColumnDataSource({"x": [], "votes": []})
        self.range = FactorRange()
        self.figure = plain(x_range=Range1d(0, 4), y_range=self.range, name="votes")
        self.figure.update(sizing_mode="stretch_width", height=220, visible=False)
        self.figure.hbar(y="x", right="votes", height=0.7, source=self.bars, color=COLOURS["theta"])
        self.figure.xaxis.ticker.min_interval = 1
        on_click(self.open, lambda event: self._open())
        on_click(self.close, lambda event: self._close())
        on_click(self.answer, lambda event: self._answer())
        if pn.state.curdoc:
            pn.state.curdoc.on_session_destroyed(lambda context: self._forget())

    @property
    def view(self):
        buttons = pn.Row(self.open, self.answer, self.close, sizing_mode="stretch_width", margin=0,
                         styles={"flex-wrap": "wrap"})  # fmt: skip
        histogram = pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", margin=0)
        explain = words(say("teach.vote.explain"))
        return [explain, self.which, buttons, self.address, self.count, histogram, self.truth]

    def _plan(self):
        step = lesson.STEPS[lesson.NAMES.index(self.which.value)]
        return step, lesson.planned(step, self._explorer.scene, self._explorer.shape)

    def _open(self):
        self._close()
        step, self._planned = self._plan()
        asks = step.asks(self._planned)
        try:
            self._room = ROOMS.open(step, step.question(self._planned), asks)
        except Refused as refused:
            self.count.object = f"<div role='alert'>{say(f'teach.vote.{refused}')}</div>"
            return
        address = f"{page_address()}?vote={self._room.code}"
        picture = segno.make(address, error="m", micro=False).svg_inline(scale=QR_MODULE, light="white")
        self.address.object = (
            f"<div>{say('teach.vote.link')}: <a href='{address}' target='_blank'>{address}</a></div>{picture}"
        )
        self.close.visible = self.answer.visible = self.figure.visible = True
        self._look()
        self._callback = pn.state.curdoc.add_periodic_callback(self._look, LOOK_EVERY)

    def _look(self):
        votes = ROOMS.tally(self._room.code)
        if votes == self._shown:
            return
        self._shown, asks = votes, self._room.asks
        if isinstance(asks, lesson.Choice):
            names = [option(self._room.step, key) for key in asks.options]
            counts = [votes.count(key) for key in asks.options]
        else:
            counts, edges = np.histogram(votes, bins=BINS, range=(asks.low, asks.high))
            names = [f"{low:.4g} – {high:.4g} {unit(asks)}" for low, high in pairwise(edges)]
        self.range.factors = names[::-1]
        self.bars.data = {"x": names, "votes": list(map(int, counts))}
        self.figure.x_range.end = max(4, max(counts) + 1)
        self.count.object = f"<div role='status'>{say('teach.vote.count', votes=len(votes), most=MOST_VOTES)}</div>"

    def _answer(self):
        room, planned = self._room, self._planned
        self.truth.object = note(say("learn.page.wait"))
        self._finding = Run(lambda run: room.step.answer(planned).truth, lambda truth: self._reveal(room, truth))
        self._runs.begin(self._finding, "vote")

    def _reveal(self, room, truth):
        step, asks = room.step, room.asks
        if isinstance(truth, Exception):
            self.truth.object = alert(told(truth)) if isinstance(truth, TopError) else ""
            if not isinstance(truth, TopError):
                raise truth
            return
        if isinstance(truth, str):
            said = option(step, truth)
        else:
            said = say("learn.verdict.never") if np.isnan(truth) else f"{truth:.4g} {unit(asks)}"
        self.truth.object = f"<b>{say('teach.vote.said', answer=said)}</b> ({say(f'learn.{step.name}.title')})"

    def _forget(self):
        if self._finding:
            self._finding.forget()
        if self._room:
            ROOMS.close(self._room.code)
        self._room = None

    def _close(self):
        if self._callback:
            pn.state.curdoc.remove_periodic_callback(self._callback)
        self._forget()
        self._callback = self._shown = None
        self.close.visible = self.answer.visible = self.figure.visible = False
        self.address.object = self.truth.object = ""
        self.count.object = say("teach.vote.shut")


def teach_view(explorer, runs):
    links = "".join(
        f"<li><a href='{link(step)}' target='_blank'>{say(f'learn.{step.name}.title')}</a></li>"
        for step in lesson.STEPS
    )
    olympiad = "".join(
        f"<dt style='margin-top: 6px'>{row['asked']}</dt><dd style='margin: 0 0 0 16px' class='key'>{row['here']}</dd>"
        for row in listed("teach.olympiad")
    )

    def tall(*cards):
        return pn.Column(*cards, sizing_mode="stretch_width", margin=0, styles={"gap": "12px"})

    def carded(key, content):
        return card(say(f"teach.page.{key}"), words(content), height="max-content")

    return grid(
        tall(
            card(say("teach.page.vote"), *Vote(explorer, runs).view, height="max-content"),
            carded("fifteen", bullets(listed("teach.plans.fifteen"), True)),
            carded("wrong", bullets(listed("teach.plans.wrong"))),
            carded("toy", bullets(listed("teach.plans.toy"))),
        ),
        tall(
            carded("links", f"<ol style='margin: 4px 0; padding-left: 20px'>{links}</ol>"),
            carded("fifty", bullets(listed("teach.plans.fifty"), True)),
            carded("olympiad", f"<dl style='margin: 0'>{olympiad}</dl>"),
        ),
    )


def history_view():
    parts = "".join(
        f"<p style='margin: 0 0 4px; font-size: {px(14)}'>{part['text']}</p><p class='key' style='margin: 0 0 12px'>"
        + " · ".join(listed(f"sources.{name}.short") for name in part["sources"]) + "</p>"
        for part in listed("history.part")
    )  # fmt: skip
    every = "".join(f"<li>{source['full']}</li>" for source in listed_all("sources"))
    return grid(
        card(say("history.page.title"), words(parts), height="max-content"),
        card(say("history.page.list"), words(f"<ol style='margin: 4px 0; padding-left: 22px'>{every}</ol>"),
             height="max-content"),
    )  # fmt: skip


def listed_all(name):
    """By year, the first that a source names."""
    year = re.compile(r"(18|19|20)\d\d")
    return sorted(listed(name).values(), key=lambda source: year.search(source["short"] + source["full"]).group())


def student_page(code):
    """What a student's link opens: one question, one prediction."""
    room, page = ROOMS.room(code), secrets.token_hex(8)
    title = f"<h2>{say('teach.student.title')}</h2>"
    if room is None:
        return pn.Column(words(f"{title}<div role='alert'>{say('teach.student.gone')}</div>"), margin=16)
    said = words("")
    widget = prediction(room.step, room.asks)
    send = pmui.Button(label=say("teach.student.send"), variant="contained", sx=PLAIN)

    def vote(event):
        key = "waiting" if widget.value is None else "sent"
        if key == "sent":
            try:
                ROOMS.vote(code, page, widget.value)
            except Refused as refused:
                key = str(refused)
        said.object = f"<div role='status'>{say(f'teach.student.{key}')}</div>"

    on_click(send, vote)
    asked = say(f"learn.{room.step.name}.question", **room.numbers)
    question = words(f"{title}<div style='font-size: {px(16)}'>{asked}</div>")
    return pn.Column(question, widget, send, said, sizing_mode="stretch_width", max_width=640, margin=16,
                     css_classes=["learn"])  # fmt: skip
