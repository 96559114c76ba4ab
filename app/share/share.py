"""What is taken home: the link with its QR code, undo and redo, and the dialog of files to save."""

import html
import time

import panel as pn
import panel_material_ui as pmui
import segno

from app.borrowed import at_once
from app.model.runs import Runs
from app.share import export, glb, programs, saved_runs
from app.share.letter import letter
from app.share.parts import Address, Clock, Photo
from app.share.prints import FIGURES, caption, draw
from app.state.keep import shared
from app.text import listed, say
from app.widgets.cards import PLAIN, words
from app.widgets.copy import Copy
from app.widgets.download import Download
from app.widgets.failure import after

# Nothing may move for so long before the address of the page is changed and a step is made, s.
REST = 0.25
SIDE = 420  # px, of the code: it is read across a table


class Share:
    """main: what was wrong with the link, and the dialog, above all views.

    keep: the page's Keep; playing: its Playing; scene: the first; runs: the page's Runs; shown: gives the
    saved_runs.Shown of the tables that are looked at. show() is for each scene.
    """

    def __init__(self, keep, playing, scene, runs=None, shown=list):
        self.keep, self._playing, self._scene, self._runs = keep, playing, scene, runs or Runs()
        self._shown, self._tables, self._rows = shown, {}, {}
        self.keep.add(Clock(playing))
        self.keep.add(playing)
        self.address = Address(search=self.keep.query, width=0, height=0, margin=0)
        at_once(self.address, "held", "gesture", "undone", "redone", "page")
        self._notice = pn.Column(sizing_mode="stretch_width", margin=0)
        self._waiting, self._changed_at = False, 0.0
        self.keep.param.watch(self._changed, "changed")
        self.keep.param.watch(self._say, "sentence")
        self._say()
        self.keep.param.watch(self._kept, "query")
        self.address.param.watch(lambda event: self.keep.undo(), "undone")
        self.address.param.watch(lambda event: self.keep.redo(), "redone")
        self._dialog = pmui.Dialog(title=say("share.dialog.title"), title_variant="h6", show_close_button=True,
                                   close_on_click=True, width_option="md", sizing_mode="stretch_width")  # fmt: skip
        self.main = [self._notice, self.address, self._dialog]
        self._kept()

    def show(self, scene):
        self._scene = scene

    @property
    def link(self):
        """The address of the page as it is now, for anybody."""
        return self.address.page + shared(self.keep.query)

    def reload(self):
        """Loads the page anew, with its state; where that cannot be, with the last that could."""
        if self._scene.messages:
            self.keep.undo()
        self.keep.at_rest()
        self.address.reloads += 1

    def _say(self, *events):
        text = self.keep.sentence
        self._notice.objects = [
            words(f'<div role="alert"><b>{html.escape(text)}</b></div>',
                  styles={"background": "#fff4e5", "padding": "8px 20px", "color": "#5c3b00"})
        ] if text else []  # fmt: skip

    def _changed(self, event):
        self._changed_at = time.monotonic()
        if not self._waiting:
            self._waiting = True
            after(REST, self._look)

    def _look(self):
        left = self._changed_at + REST - time.monotonic()
        if self.address.held or left > 0:
            after(REST if self.address.held else left, self._look)
            return
        self._waiting = False
        self.keep.at_rest(self.address.gesture)

    def _kept(self, *events):
        self.address.search = self.keep.query

    # --- the dialog ---

    def open(self):
        """Opens the dialog, of what is shown now."""
        if not self._dialog.objects:
            self._make()
        link = self.link
        self._link.text = link
        try:
            code = segno.make(link, error="m", micro=False)
            squares = code.symbol_size(border=0)[0]
            picture = code.svg_inline(omitsize=True, dark="black", light="white", title=say("share.dialog.code"))
            self._code.object = f'<div style="width: min({SIDE}px, 100%); margin: 8px auto">{picture}</div>'
            self._length.object = say("share.dialog.length", letters=len(link), squares=squares)
        except segno.DataOverflowError:
            self._code.object = ""
            self._length.object = say("share.dialog.too_long", letters=len(link))
        self._show_python()
        self._show_tables()
        self._photo.caption = self._photo_caption()
        self._dialog.open = True

    def _make(self):
        text = {"button": listed("share.copy"), "sizing_mode": "stretch_width", "margin": (4, 0)}
        self._link = Copy(label=say("share.dialog.link_label"), **text)
        self._code, self._length = words(""), words("", margin=(4, 0))
        self._photo = Photo(margin=0, none=say("share.no_top"))
        self._python = Copy(label="Python", rows=13, **text)
        self._run_python = Copy(label="Python", rows=4, **text)
        shown = listed("share.python")
        codes = {shown[name]: name for name in programs.PYTHON}
        self._which = pmui.RadioButtonGroup(options=codes, value=next(iter(programs.PYTHON)), label="",
                                            size="small", margin=(4, 0), sx=PLAIN)  # fmt: skip
        self._which.param.watch(lambda event: self._show_python(), "value")
        self._runs_group = pn.Column(sizing_mode="stretch_width", margin=0, visible=False)
        groups = {"figures": self._figures(), "numbers": self._numbers(), "without": self._without(),
                  "python": [self._which, self._python]}  # fmt: skip
        self._groups = pmui.Accordion(
            *((say(f"share.dialog.{name}"), pn.Column(*rows, sizing_mode="stretch_width", margin=0))
              for name, rows in groups.items()),
            active=[], sizing_mode="stretch_width", margin=(8, 0), title_variant="subtitle2", elevation=0,
        )  # fmt: skip
        self._dialog.objects = [self._link, self._code, self._length, self._runs_group, self._groups]

    def _figures(self):
        return [
            *(_row(say(f"prints.figures.{name}"), *(
                self._download(kind.upper(), f"tippe-top-{name}.{kind}", _print(name, kind)) for kind in ("png", "svg")
            )) for name in FIGURES),
            _row(say("share.dialog.photo"), self._photo),
        ]  # fmt: skip

    def _numbers(self):
        return [
            _row(say("share.dialog.motion"), self._download("CSV", "tippe-top-motion.csv", export.motion_csv)),
            _row(say("share.dialog.tielines"), self._download("CSV", "tippe-top-tielines.csv", export.tielines_csv)),
            _row(say("share.dialog.arrays"), self._download("NPZ", "tippe-top.npz", export.arrays_npz)),
        ]

    def _without(self):
        return [
            _row(say("share.dialog.letter"), self._download("HTML", "tippe-top.html", self._letter)),
            _row(say("share.dialog.animation"), self._download(
                "GLB", "tippe-top.glb", lambda scene, link: glb.animation_glb(scene, self._slower))),
        ]  # fmt: skip

    def _show_tables(self):
        """What there is of the runs on the tables that are looked at."""
        self._tables = {shown.name: shown for shown in self._shown()}
        self._runs_group.visible = bool(self._tables)
        if not self._tables:
            return
        for name in self._tables.keys() - self._rows.keys():
            self._rows[name] = self._run_row(name)
        self._run_python.text = "\n".join(map(saved_runs.run_python, self._tables.values()))
        self._runs_group.objects = [
            _heading("runs", margin=(8, 0, 4, 0)), *(self._rows[name] for name in self._tables), self._run_python
        ]  # fmt: skip

    def _run_row(self, name):
        prints = {kind.upper(): lambda shown, link, kind=kind: saved_runs.run_print(shown, kind)
                  for kind in ("png", "svg")}  # fmt: skip
        animation = {"GLB": lambda shown, link: saved_runs.run_glb(shown, self._slower)}
        kinds = {"CSV": saved_runs.run_csv, "NPZ": saved_runs.run_npz} | prints | animation
        files = [
            Download(self._runs, lambda: (self._tables[name], self.link), make, label=kind, margin=0,
                     filename=f"tippe-top-{name}.{kind.lower()}")
            for kind, make in kinds.items()
        ]  # fmt: skip
        return _row(say(f"share.tables.{name}"), *files)

    def _photo_caption(self):
        """Of what is in sight: of three tops the words that all have."""
        shown = list(self._tables.values())
        lines = saved_runs.caption(shown[0])[: 1 if len(shown) > 1 else 2] if shown else caption(self._scene)
        return list(plain(lines))

    @property
    def _slower(self):
        return 1 / self._playing.speed

    def _letter(self, scene, link):
        return letter(scene, link, self._playing.chosen)

    def _show_python(self):
        self._python.text = programs.PYTHON[self._which.value](self._scene)

    def _download(self, label, filename, make):
        return Download(self._runs, lambda: (self._scene, self.link), make, label=label, filename=filename,
                        margin=0)  # fmt: skip


def _print(name, kind):
    return lambda scene, link: draw(scene, name, kind)


def _heading(name, **options):
    return words(f"<h2>{say(f'share.dialog.{name}')}</h2>", **options)


def _row(says, *buttons):
    return pn.Column(
        words(says, sizing_mode=None, styles={"flex": "1 1 120px"}),
        *buttons,
        sizing_mode="stretch_width",
        margin=(2, 0),
        styles={"display": "flex", "flex-flow": "row wrap", "gap": "8px", "align-items": "center", "width": "100%"},
    )


def plain(lines):
    """Lines without their mathtext."""
    marks = {
        "$": "",
        r"\mu": "μ",
        r"\theta": "θ",
        r"\gamma": "γ",
        r"\epsilon": "ε",
        "^2": "²",
        "^{1/2}": "½",
        "{": "",
        "}": "",
        "_": "",
    }
    for line in lines:
        for mark, sign in marks.items():
            line = line.replace(mark, sign)
        yield line
