"""Share: the link with its QR code, undo and redo, and the files to save."""

import html
from urllib.parse import parse_qs, urlsplit

import param

from app.borrowed import at_once
from app.model.runs import Runs
from app.share.panel import Files
from app.share.parts import Address, Clock, ShareHead
from app.state.names import is_local
from app.state.url_state import shared
from app.text import say
from app.widgets.cards import column, words
from app.widgets.codes import qr
from app.widgets.rest import Rest

# It covers the cards beside the stage, never the stage itself; as wide as those are in the Lab.
PLACE = """
:host { position: fixed; z-index: 15; inset: calc(48px * var(--type, 1)) 0 0 auto; width: 488px; height: auto;
  max-height: none; align-self: auto; overflow: auto; padding: 12px 24px 24px; box-sizing: border-box;
  background: var(--card); border-left: 1px solid var(--rule) }
@media (min-width: 1500px) { :host { width: 641px; padding: 12px 32px 24px } }
@media (max-width: 1180px) { :host { width: 393px; padding: 12px 16px 24px } }
@media (max-width: 700px) { :host { width: 100%; bottom: calc(53px + env(safe-area-inset-bottom)); border: 0 } }
"""
UNROLLED = ":host { max-height: none !important }"


# Over the page, so that nothing moves when it goes.
NOTICE = """
:host { position: fixed; z-index: 15; inset: calc(48px * var(--type, 1) + 8px) 24px auto auto;
  width: auto !important; max-width: 560px }
[role=alert] { background: var(--card); color: var(--ink); border: 1px solid var(--control-line); border-radius: 8px;
  padding: 8px 16px; box-shadow: 0 2px 8px rgb(0 0 0 / 30%) }
@media (max-width: 700px) { :host { inset: auto 8px 64px } }
"""


class Share(param.Parameterized):
    """main: errors in the link, and the panel that is laid over the page.

    url_state: the page's UrlState; playing: its Playing; scene: the first one; runs: the page's Runs; shown: returns
    the saved_runs.Shown of the tables that are shown; busy: whether others are being computed; settle: solves the scene
    of the present inputs, if that was postponed; body: returns the body of the page's top; sheet: returns the worksheet
    for a class, of a Scene; mail: returns the page to mail, of a Scene and its link. show() is for the scene of a hand
    at rest.
    """

    is_open = param.Boolean(default=False)

    def __init__(self, url_state, playing, scene, runs=None, shown=list, busy=bool, settle=bool, body=lambda: None,
                 sheet=lambda scene: "", mail=lambda scene, link: b""):  # fmt: skip
        super().__init__()
        self.url_state, self._playing, self._scene, self._runs = url_state, playing, scene, runs or Runs()
        self._shown, self._busy, self._settle, self._body, self._sheet = shown, busy, settle, body, sheet
        self._mail, self._files = mail, None
        self.url_state.add(Clock(playing))
        self.url_state.add(playing)
        self.address = Address(search=self.url_state.query, where=self.url_state.where, width=0, height=0, margin=0)
        at_once(self.address, "held", "gesture", "undone", "redone", "page", "visited")
        self._notice = column()
        self._rest = Rest(self._rests, lambda: self.address.held)
        self.url_state.param.watch(lambda event: self._rest.moved(), "changed")
        self.url_state.param.watch(self._say, "sentence")
        self._say()
        self.url_state.param.watch(self._kept, ["query", "where"])
        self.address.param.watch(lambda event: self.url_state.undo(), "undone")
        self.address.param.watch(lambda event: self.url_state.redo(), "redone")
        self.address.param.watch(lambda event: self.url_state.visit(event.new[1]), "visited")
        self.panel = column(sizing_mode=None, visible=False, stylesheets=[PLACE])
        self.main = [self._notice, self.address, self.panel]
        self._kept()

    def show(self, scene):
        self._scene = scene
        self.refresh()

    @property
    def link(self):
        """The present address of the page, without secrets."""
        return self.address.page + shared(self.url_state.query)

    def reload(self):
        """Reloads the page with its state, or, if that is impossible, with the last valid one."""
        if self._scene.messages:
            self.url_state.undo()
        self.url_state.commit()
        self.address.reloads += 1

    def _say(self, *events):
        text = self.url_state.sentence
        self._notice.objects = [
            words(f'<div role="alert"><b>{html.escape(text)}</b></div>', NOTICE)
        ] if text else []  # fmt: skip

    def _rests(self):
        """Updates the address and makes a step of undo."""
        self.url_state.commit(self.address.gesture)
        self.refresh()

    def _kept(self, *events):
        self.address.where = self.url_state.where  # first: its entry of the history is new, and then gets the query
        self.address.search = self.url_state.query
        self.refresh()

    # --- what is laid over the page, beside the stage ---

    def toggle(self):
        """Opens it for what is shown now, or closes it."""
        self.close() if self.is_open else self.open()

    def open(self):
        if self._files is None:
            self._make()
        self._show()
        self._head.opened += 1
        self.panel.visible = self.is_open = True

    def close(self):
        self.panel.visible = self.is_open = False

    def refresh(self, *events):
        """To be called when something else may be shown. While a hand is moving, the link does not have that yet, so
        the panel waits for the link."""
        if self.is_open and not self._rest.is_due:
            self._show()

    def _show(self):
        self._settle()
        link, picture = self.link, self._head.picture
        if link != self._head.link:
            picture = qr(link, say("share.panel.qr"))
        at = None if self._playing.playing else self._playing.time * self._scene.scales.time
        wording = [
            say("share.panel.opens") if at is None or not self._rolls() else say("share.panel.opens_at", time=at),
            "" if picture else say("share.panel.too_long", letters=len(link)),
            say("share.panel.local") if is_local(urlsplit(link).hostname or "") else "",
        ]
        self._head.param.update(link=link, picture=picture, wording=[each for each in wording if each])
        if not self._busy():  # else the files are still those of the previous motion, with its own link
            self._files.show(self._scene, {shown.table: shown for shown in self._shown()}, link)
            self._saves.visible = True

    def _rolls(self):
        return "t" in parse_qs(urlsplit(self.link).query)

    def _make(self):
        self._head = ShareHead(margin=0, sizing_mode="stretch_width")
        at_once(self._head, "closed")
        self._head.param.watch(lambda event: self.close(), "closed")
        self._files = Files(self._runs, self._playing, self._body, self._sheet, self._mail)
        self._saves = column(*self._files.view, visible=False, stylesheets=[UNROLLED])
        self.panel.objects = [self._head, self._saves]
