"""The rows of Share: one for each kind of file, and the paper's figures in a fold."""

import html

from app.share import export, glb, programs, saved_runs
from app.share.parts import Embed, Film, Paper, Photo
from app.share.prints import FIGURES, caption, draw
from app.share.saved_runs import Shown
from app.state.names import FRAME, VERSION, VERSION_NAME
from app.text import listed, say
from app.widgets.cards import column, px, words
from app.widgets.copy import Copy
from app.widgets.download import Download
from app.widgets.forms import Choice, Fold
from tippe_core import BareSphere

ROWS = {"pictures": ("png", "svg"), "data": ("csv", "npz"), "solid": ("glb",), "code": ("py",)}
HEIGHT = 700  # px, of a frame 900 px wide
SLOW = 16  # times slower than the real top, unless a speed was chosen
NAMES = {kind: kind.upper() for kind in ("png", "svg", "csv", "glb", "stl", "html")} | {"npz": "NumPy", "py": ".py"}
ROW = """
:host { display: flex; flex-flow: row wrap; gap: 8px; align-items: center; padding: 6px 0; min-height: 47px;
  border-top: 1px solid var(--rule); box-sizing: border-box }
"""
SAYS = f"b {{ font-size: {px(14)} }} small {{ display: block; font-size: {px(12)}; color: var(--faint) }}"


def made(kind, what, link, slower):
    """The bytes of a file of a Shown or of a Scene; slower: how many times slower than in reality it is played."""
    run = isinstance(what, Shown)
    match kind:
        case "png" | "svg":
            return saved_runs.run_print(what, kind) if run else draw(what, "motion", kind)
        case "csv":
            return (saved_runs.run_csv if run else export.motion_csv)(what, link)
        case "npz":
            return (saved_runs.run_npz if run else export.arrays_npz)(what, link)
        case "glb":
            return (saved_runs.run_glb if run else glb.animation_glb)(what, slower)
    return f"# {link}\n{(saved_runs.run_python if run else programs.python_of_motion)(what)}".encode()


def embedded(link):
    """The code that shows what a link opens in a frame of another page."""
    framed = link + ("&" if "?" in link else f"?{VERSION_NAME}={VERSION}&") + f"{FRAME}=1"
    return (
        f'<iframe src="{html.escape(framed)}" title="{html.escape(say("main.title"))}" width="100%" '
        f'height="{HEIGHT}" style="border: 0" allow="fullscreen; clipboard-write"></iframe>'
    )


class Files:
    """view: the rows. runs: the page's Runs; playing: its Playing; body: returns the body that can be printed, or None;
    sheet: returns the worksheet for a class, of a Scene; mail: returns the page to mail, of a Scene and its link.
    show(scene, shown, link) sets what is now on the page, and the link that opens it; shown: {table: Shown}, empty if
    the rolling motion is shown."""

    def __init__(self, runs, playing, body, sheet, mail):
        self._runs, self._playing, self._body = runs, playing, body
        self._scene, self._shown, self._link = None, {}, ""
        tables = listed("share.tables")
        self._table = Choice({tables[name]: name for name in tables}, next(iter(tables)), margin=(4, 0))
        self._table.on("value", lambda event: self._name())
        self._of = words("", margin=(4, 0))
        self._photo, self._film = Photo(margin=0, none=say("share.no_top")), Film(margin=0, sizing_mode="stretch_width")
        self._embed = Embed(margin=0, sizing_mode="stretch_width")
        self._saves = {kind: self._save(kind) for kinds in ROWS.values() for kind in kinds}
        self._mesh = Download(runs, lambda: (body(),), lambda shape: shape.stl(), label=NAMES["stl"],
                              filename="tippe-top.stl", margin=0)  # fmt: skip
        rows = {name: [self._saves[kind] for kind in kinds] for name, kinds in ROWS.items()}
        rows["solid"].append(self._mesh)
        wording = {name: _says(_titled(name)) for name in ("photo", *ROWS, "letter", "sheet")}
        self._solid = wording["solid"]
        mailed = self._of_scene(NAMES["html"], "tippe-top.html", mail)
        self._sheet, self._paper = sheet, Paper(margin=0, label=say("share.panel.print"))
        rows = {"photo": [self._photo]} | rows | {"letter": [mailed], "sheet": [self._paper]}
        self._python = Copy(label="Python", rows=13, button=listed("share.copy"), sizing_mode="stretch_width",
                            margin=(4, 0))  # fmt: skip
        figures = column(*self._figures())
        self._more = Fold(say("share.panel.figures"), figures, margin=(8, 0))
        self.view = [
            self._of, self._table,
            _row(wording["photo"], *rows.pop("photo")), _row(self._film),
            *(_row(wording[name], *saves) for name, saves in rows.items()),
            _row(self._embed), self._more,
        ]  # fmt: skip

    def _save(self, kind):
        return Download(self._runs, lambda: (self._what, self._link, 1 / (self._playing.speed or SLOW)),
                        lambda *what: made(kind, *what), label=NAMES[kind], filename=kind,
                        margin=0)  # fmt: skip

    def _of_scene(self, label, filename, make):
        return Download(self._runs, lambda: (self._scene, self._link), make, label=label, filename=filename,
                        margin=0)  # fmt: skip

    def _figures(self):
        shown = listed("share.python")
        codes = {shown[name]: name for name in programs.PYTHON}
        self._which = Choice(codes, next(iter(programs.PYTHON)), margin=(4, 0))
        self._which.on("value", lambda event: self._show_python())
        prints = [
            _row(_says(say(f"prints.figures.{name}")), *(
                self._of_scene(kind.upper(), f"tippe-top-{name}.{kind}", _print(name, kind)) for kind in ("png", "svg")
            )) for name in FIGURES
        ]  # fmt: skip
        tielines = self._of_scene(NAMES["csv"], "tippe-top-tielines.csv", export.tielines_csv)
        says = words(say("share.panel.python"), margin=(8, 0, 0, 0))
        return [*prints, _row(_says(say("share.panel.tielines")), tielines), says, self._which, self._python]

    @property
    def _what(self):
        """The motion from which the files are made."""
        return self._shown.get(self._table.value, self._scene) if self._shown else self._scene

    def show(self, scene, shown, link):
        another = scene is not self._scene
        self._scene, self._shown, self._link = scene, shown, link
        if shown and self._table.value not in shown:
            self._table.value = next(iter(shown))
        self._table.visible = len(shown) > 1
        self._film.anew += 1
        self._embed.code = embedded(link)
        shape = self._body()
        self._mesh.visible = shape is not None and not isinstance(shape, BareSphere)
        self._solid.object = _titled("solid", "print" if self._mesh.visible else "says")
        self._photo.caption = self._caption()
        self._name()
        if another:
            self._paper.page = self._sheet(scene)
            self._show_python()

    def _name(self):
        """The caption that says which motion the files contain, and their names."""
        table = self._table.value if self._shown else ""
        wording = (
            say("share.panel.of_table", table=say(f"share.tables.{table}")) if table else say("share.panel.of_rolling")
        )
        self._of.object = f"<b>{wording}</b>"
        for kind, save in self._saves.items():
            save.filename = f"tippe-top-{table or 'motion'}.{kind}"

    def _caption(self):
        """The caption of what is shown; for three tops, the words that they share."""
        shown = list(self._shown.values())
        lines = saved_runs.caption(shown[0])[: 1 if len(shown) > 1 else 2] if shown else caption(self._scene)
        return list(plain(lines))

    def _show_python(self):
        self._python.text = programs.PYTHON[self._which.value](self._scene)


def _print(name, kind):
    return lambda scene, link: draw(scene, name, kind)


def _titled(name, says="says"):
    return f"<b>{say(f'share.panel.{name}.title')}</b><small>{say(f'share.panel.{name}.{says}')}</small>"


def _says(text):
    return words(text, sizing_mode=None, style=SAYS, styles={"flex": "1 1 150px"})


def _row(says, *buttons):
    return column(says, *buttons, stylesheets=[ROW])


def plain(lines):
    """The lines without mathtext."""
    marks = {"$": "", r"\mu": "μ", r"\theta": "θ", r"\gamma": "γ", r"\epsilon": "ε", "^2": "²", "^{1/2}": "½",
             "{": "", "}": "", "_": ""}  # fmt: skip
    for line in lines:
        for mark, sign in marks.items():
            line = line.replace(mark, sign)
        yield line
