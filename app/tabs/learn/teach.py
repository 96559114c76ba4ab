"""For teachers: links, plans, what goes wrong, the Olympiad's problem, the toy, and a vote."""

import re
from itertools import pairwise

import numpy as np
import panel as pn
import panel_material_ui as pmui
import segno
from bokeh.models import ColumnDataSource, FactorRange, Range1d

from app.model import lesson, lesson_parts
from app.model.ballots import Away
from app.model.classroom import MOST_VOTES, Refused
from app.model.colours import COLOURS
from app.model.runs import Run
from app.state import names
from app.tabs.learn.poll import Counter, asked_of, option, page_address, question_of, refusal, truth_of
from app.text import listed, say, told
from app.widgets.cards import PLAIN, alert, card, grid, note, on_click, px, words
from app.widgets.plots import plain
from tippe_core import TopError

BINS = 12
QR_MODULE = 4


def link(step):
    """The query that opens a step."""
    return names.link(tab="learn", step=step.name)


def bullets(items, ordered=False):
    kind = "ol" if ordered else "ul"
    return f"<{kind} style='margin: 4px 0; padding-left: 20px'>{''.join(f'<li>{item}</li>' for item in items)}</{kind}>"


class Vote:
    """The teacher's side of a vote: opens a room about a step on the present top, and shows its histogram.

    now: what returns the present scene; kept: whose `room` is the key of the room, or ""; a link with the key opens the
    room again.
    """

    def __init__(self, now, runs, kept):
        self._now, self._runs, self._kept = now, runs, kept
        self._counter, self._room, self._finding = Counter(), None, None
        titles = {f"{i}. {say(f'learn.{name}.title')}": name for i, name in enumerate(lesson.NAMES, 1)}
        self.which = pmui.Select(label=say("teach.vote.which"), options=titles, value=lesson.NAMES[0], size="small",
                                 sizing_mode="stretch_width")  # fmt: skip
        self.open, self.answer, self.close, self.again = (
            pmui.Button(label=say(f"teach.vote.{name}"), variant="contained" if name == "open" else "outlined",
                        size="small", sx=PLAIN, visible=name == "open")
            for name in ("open", "answer", "close", "again")
        )  # fmt: skip
        self.address, self.count, self.truth = words(""), words(say("teach.vote.shut")), words("")
        self.bars = ColumnDataSource({"x": [], "votes": []})
        self.range = FactorRange()
        self.figure = plain(x_range=Range1d(0, 4), y_range=self.range, name="votes")
        self.figure.update(sizing_mode="stretch_width", height=220, visible=False)
        self.figure.hbar(y="x", right="votes", height=0.7, source=self.bars, color=COLOURS["theta"])
        self.figure.xaxis.ticker.min_interval = 1
        on_click(self.open, lambda event: self._room or self._open())
        # a hidden button can be clicked too, by who speaks to the server without its page
        on_click(self.close, lambda event: self._room and self._close())
        on_click(self.answer, lambda event: self._room and self._answer())
        on_click(self.again, lambda event: kept.room and self._return())
        if kept.room:
            self._return()

    @property
    def view(self):
        buttons = pn.Row(self.open, self.answer, self.close, self.again, sizing_mode="stretch_width", margin=0,
                         styles={"flex-wrap": "wrap"})  # fmt: skip
        histogram = pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", margin=0)
        explain = words(say("teach.vote.explain"))
        return [explain, self.which, buttons, self.address, self.count, histogram, self.truth]

    def _ask(self, work, done):
        self.count.object = note(say("teach.vote.wait"))
        self._counter.ask(work, done)

    def _open(self):
        try:
            question = asked_of(lesson.STEPS[lesson.NAMES.index(self.which.value)], self._now())
        except TopError as error:
            self._say(alert(told(error)))
            return
        before, address = self._kept.room, self._counter.address

        def work(rooms):
            opened = rooms.open(address, **question)
            if before:
                rooms.close(before)
            return opened

        def done(result):
            if isinstance(result, Exception):
                self._say(refusal("vote", result))
            else:
                room, self._kept.room = result
                self._take(room)

        self._ask(work, done)

    def _return(self):
        """To the room of the link."""
        key = self._kept.room

        def done(result):
            self.again.visible = isinstance(result, Away)
            if isinstance(result, Refused):
                self._shut(refusal("vote", result))
            elif isinstance(result, Away):
                self._say(refusal("vote", result))
            else:
                self._take(result)

        self._ask(lambda rooms: rooms.owned(key), done)

    def _close(self):
        key = self._kept.room

        def done(result):
            if isinstance(result, Exception):
                self._say(refusal("vote", result))
            else:
                self._shut(say("teach.vote.shut"))

        self._ask(lambda rooms: rooms.close(key), done)

    def _take(self, room):
        """The room that is open from now on."""
        self._forget()
        self._room, (self._step, self._asks) = room, question_of(room)
        if self._step is None:
            self._shut(refusal("vote", Refused("over")))
            return
        self.which.value = room.step
        address = page_address() + names.link(vote=room.code)
        mine = page_address() + names.link(tab="learn", learn="teach", room=self._kept.room)
        picture = segno.make(address, error="m", micro=False).svg_inline(scale=QR_MODULE, light="white")
        self.address.object = (
            f"<div>{say('teach.vote.link')}: <a href='{address}' target='_blank'>{address}</a></div>{picture}"
            f"<details><summary>{say('teach.vote.mine')}</summary><a href='{mine}'>{mine}</a></details>"
        )
        self.close.visible = self.answer.visible = self.figure.visible = True
        self.open.visible = False  # it would close this one
        self._show(room)
        self._counter.watch(room.code, self._news)

    def _news(self, room):
        if room is None:
            self._shut(refusal("vote", Refused("over")))
        elif isinstance(room, Away):
            self._say(refusal("vote", room))
        else:
            self._show(room)

    def _show(self, room):
        votes, asks = list(room.votes), self._asks
        if isinstance(asks, lesson_parts.Choice):
            names = [option(self._step, key) for key in asks.options]
            counts = [votes.count(key) for key in asks.options]
        else:
            counts, edges = np.histogram(votes, bins=BINS, range=(asks.low, asks.high))
            names = [f"{low:.4g} – {high:.4g} {asks.unit}" for low, high in pairwise(edges)]
        self.range.factors = names[::-1]
        self.bars.data = {"x": names, "votes": list(map(int, counts))}
        self.figure.x_range.end = max(4, max(counts) + 1)
        self._say(f"<div role='status'>{say('teach.vote.count', votes=len(votes), most=MOST_VOTES)}</div>")

    def _say(self, sentence):
        self.count.object = sentence

    def _answer(self):
        room, step, asks = self._room, self._step, self._asks
        self._forget()
        self.truth.object = note(say("learn.view.wait"))
        self._finding = Run(lambda run: truth_of(step, room.top), lambda truth: self._reveal(step, asks, truth))
        self._runs.begin(self._finding, "vote")

    def _reveal(self, step, asks, truth):
        if isinstance(truth, Exception):
            self.truth.object = alert(told(truth)) if isinstance(truth, TopError) else ""
            if not isinstance(truth, TopError):
                raise truth
            return
        if isinstance(truth, str):
            said = option(step, truth)
        else:
            said = say("learn.view.never") if np.isnan(truth) else f"{truth:.4g} {asks.unit}"
        self.truth.object = f"<b>{say('teach.vote.said', answer=said)}</b> ({say(f'learn.{step.name}.title')})"

    def _forget(self):
        if self._finding:
            self._finding.forget()
        self.truth.object = ""

    def _shut(self, sentence):
        """No room is open here any more, and why."""
        self._counter.leave()
        self._forget()
        self._room, self._kept.room = None, ""
        self.close.visible = self.answer.visible = self.again.visible = self.figure.visible = False
        self.open.visible = True
        self.address.object = ""
        self._say(sentence)


def teach_view(now, runs, kept):
    """now, kept: see Vote."""
    links = "".join(
        f"<li><a href='{link(step)}' target='_blank'>{say(f'learn.{step.name}.title')}</a></li>"
        for step in lesson.STEPS
    )
    olympiad = "".join(
        f"<dt style='margin-top: 6px'>{row['asked']}</dt><dd style='margin: 0 0 0 16px' class='key'>{row['here']}</dd>"
        for row in listed("teach.olympiad")
    )

    def tall(*cards):
        # its own height: a phone's page is lower than these cards, and the next column would lie over them
        styles = {"gap": "12px", "height": "max-content", "max-height": "none"}
        return pn.Column(*cards, sizing_mode="stretch_width", margin=0, styles=styles)

    def carded(key, content):
        return card(say(f"teach.page.{key}"), words(content), height="max-content")

    return grid(
        tall(
            card(say("teach.page.vote"), *Vote(now, runs, kept).view, height="max-content"),
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
