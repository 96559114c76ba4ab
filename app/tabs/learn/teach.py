"""For teachers: a class, links, plans, common errors, the Olympiad's problem, and the toy."""

import re

from app.model.lesson import lesson
from app.state import names
from app.text import listed, say
from app.widgets.cards import card, flow, grid, px, tall, words
from app.widgets.forms import Button


def link(step):
    """The query that opens a step."""
    return names.link(tab="learn", step=step.name)


def bullets(items, ordered=False):
    kind = "ol" if ordered else "ul"
    return f"<{kind} style='margin: 4px 0; padding-left: 20px'>{''.join(f'<li>{item}</li>' for item in items)}</{kind}>"


def teach_view(present, close):
    """present, close: begin and end a class."""
    links = "".join(
        f"<li><a href='{link(step)}' target='_blank'>{say(f'learn.{step.name}.title')}</a></li>"
        for step in lesson.STEPS
    )
    olympiad = "".join(
        f"<dt style='margin-top: 6px'>{row['asked']}</dt><dd style='margin: 0 0 0 16px' class='key'>{row['here']}</dd>"
        for row in listed("teach.olympiad")
    )

    buttons = Button(say("teach.vote.present"), present, kind="primary"), Button(say("teach.vote.close"), close)

    def carded(key, content):
        return card(say(f"teach.page.{key}"), words(content))

    def planned(key, ordered=False):
        return carded(key, bullets(listed(f"teach.plans.{key}"), ordered))

    vote = card(say("teach.page.vote"), words(say("teach.vote.explain")), flow(*buttons))
    links = carded("links", f"<ol style='margin: 4px 0; padding-left: 28px'>{links}</ol>")
    olympiad = carded("olympiad", f"<dl style='margin: 0'>{olympiad}</dl>")
    return grid(tall(vote, planned("fifteen", True), planned("wrong"), planned("toy")),
                tall(links, planned("fifty", True), olympiad))  # fmt: skip


def history_view():
    parts = "".join(
        f"<p style='margin: 0 0 4px; font-size: {px(14)}'>{part['text']}</p><p class='key' style='margin: 0 0 12px'>"
        + " · ".join(listed(f"sources.{name}.short") for name in part["sources"]) + "</p>"
        for part in listed("history.part")
    )  # fmt: skip
    every = "".join(f"<li>{source['full']}</li>" for source in sources_by_year())
    return grid(
        card(say("history.page.title"), words(parts)),
        card(say("history.page.list"), words(f"<ol style='margin: 4px 0; padding-left: 22px'>{every}</ol>")),
    )  # fmt: skip


def sources_by_year():
    """Sorted by the first year that each one names."""
    year = re.compile(r"(18|19|20)\d\d")
    return sorted(listed("sources").values(), key=lambda source: year.search(source["short"] + source["full"]).group())
