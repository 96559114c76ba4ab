"""The building blocks of the page: cards, text in the page's own type, a grid that fits a phone."""

import panel as pn

from app.widgets.form import Form
from app.widgets.light import Stack, Words
from app.widgets.typeset import typeset

# The stage at the right of the other cards. On a narrow page both give their cards to one column.
HEAD = "calc(48px * var(--type, 1))"
STAGED = """
:host { display: flex; flex-direction: column; gap: 24px; padding: 12px 16px 16px; min-height: max-content }
@media (min-width: 1000px) {
  :host { display: grid; align-items: start; padding: 12px 24px 24px;
    grid-template-columns: minmax(0, 43fr) minmax(0, 57fr) }
}
"""
SIDE = """
:host { display: contents }
@media (min-width: 1000px) { :host { display: flex; flex-direction: column; gap: 24px } }
"""
IN_SIGHT = "@media (min-width: 1000px) and (min-height: 700px) { :host { position: sticky; top: calc(HEAD + 12px) } }"
# The card with the stage. On a narrow page it stays in sight below the head; otherwise it is as high as the cards
# below it, which stay in sight too, allow.
FIRST = """
:host { position: sticky; top: HEAD; z-index: 5; height: min(50vh, 400px) !important }
@media (max-width: 700px) { :host { height: 330px !important } }
@media (min-width: 1000px) { :host { position: static; height: HIGH !important } }
""".replace("HIGH", "clamp(390px, 100vh - HEAD - 24px, 52vw)")
TYPE = """
:host { font: calc(14px * var(--type, 1))/1.45 var(--family, system-ui, sans-serif); color: var(--ink) }
h2 { font-size: calc(14px * var(--type, 1)); margin: 0; font-weight: 600 }
.key, .note { color: var(--faint); font-size: calc(12px * var(--type, 1)) }
.alert { font-weight: 600 }
.alert::before { content: "!" / ""; display: inline-grid; place-items: center; width: 1.5em; height: 1.5em;
  margin-right: 6px; border-radius: 50%; background: var(--ink); color: var(--card) }
i, sub { font-family: Georgia, serif } sub, sup { font-size: 0.75em; line-height: 0 }
.key span { white-space: nowrap } [title] { cursor: help }
.axis { text-align: center } b { font-weight: 600 }
.quantity { font-size: calc(14px * var(--type, 1)); text-align: right }
.swatch { display: inline-block; width: 18px; border-top: 3px solid; margin: 0 4px 0 10px; vertical-align: middle }
progress { appearance: none; width: min(100%, 240px); height: 6px; border: 0; border-radius: 3px; overflow: hidden;
  background: var(--rule) } progress::-webkit-progress-bar { background: var(--rule) }
progress::-webkit-progress-value { background: var(--ink) }
progress::-moz-progress-bar { background: var(--ink) }
a, summary { color: var(--link) } summary { cursor: pointer; padding: 4px 0 }
li > a { display: inline-block; padding: 5px 0 }
"""
# For words that have a table.
TABLE = """
table { border-collapse: collapse; margin: 6px 0; font-size: inherit; font-variant-numeric: tabular-nums }
td, th { padding: 3px 12px 3px 0; text-align: left; font-weight: normal; vertical-align: baseline }
th { color: var(--faint) }
"""

WRAPS, ROOM = {"display": "flex", "flex-flow": "row wrap"}, {"gap": "24px", "padding": "12px 24px 24px"}


def px(size):
    """A font size in CSS, larger for a projector."""
    return f"calc({size}px * var(--type, 1))"


def words(text="", style="", **options):
    """Text as HTML; style: additional CSS."""
    return Words(object=text, stylesheets=[TYPE + style], **options)


def stack(*parts, **options):
    """Parts, one below the other, which stay."""
    return Stack(objects=[*parts], **options)


def column(*parts, **options):
    """Parts, one below the other, which may change."""
    return pn.Column(*parts, **({"sizing_mode": "stretch_width", "margin": 0} | options))


def areas(sheet, inside=(), /, **content):
    """Parts that a style sheet arranges by their names, which are their classes; inside: sheets of each."""
    parts = [stack(*part, css_classes=[name], stylesheets=[*inside]) for name, part in content.items()]
    return Form(stack(*parts, stylesheets=[sheet]))


def alert(text):
    """An error message, plain text."""
    return f'<div class="alert" role="alert">{typeset(text)}</div>' if text else ""


def note(text):
    return f'<div class="note">{text}</div>' if text else ""


def tall(*cards):
    """A column of a grid with its own height: its cards are higher than a phone's page, and the next column would hide
    them."""
    styles = {"gap": "24px", "height": "max-content", "max-height": "none"}
    return stack(*cards, styles=styles)


def progress(percent, says):
    """A progress bar; says: its name for screen readers."""
    return f'<progress max="100" value="{percent:.0f}" aria-label="{says}"></progress>'


def swatch(colour, text, style="solid"):
    return f'<span><span class="swatch" style="border-color: {colour}; border-top-style: {style}"></span>{text}</span>'


def card(title, *content):
    """A part of a room, with its title."""
    styles = {"height": "max-content", "box-sizing": "border-box", "overflow": "hidden"}
    return stack(words(f"<h2>{title}</h2>"), *content, styles=styles)


def flow(*content, margin=(6, 0)):
    """A row that wraps if there is too little room."""
    return stack(*content, margin=margin, styles=WRAPS | {"gap": "8px", "align-items": "center"})


def grid(*cards):
    """Cards side by side where there is room."""
    columns = "repeat(auto-fit, minmax(min(100%, 480px), 1fr))"
    return Form(stack(*cards, styles=ROOM | {"display": "grid", "grid-template-columns": columns}))


class Hidden(pn.Column):
    """A column whose content is created when it is first shown: parts that nobody sees cost as much as others. make:
    a function that returns a list of them."""

    def __init__(self, make):
        super().__init__(sizing_mode="stretch_width", margin=0, visible=False)
        self._make = make
        self.param.watch(self._fill, "visible")

    def _fill(self, event):
        make, self._make = self._make, None
        if make:
            self.objects = [Form(*make())]


def first(made):
    """Makes a card the first of a stage."""
    made.stylesheets = [*made.stylesheets, FIRST.replace("HEAD", HEAD)]
    return made


def staged(stage, others):
    """The cards of the stage and the other cards: side by side if there is room, the stage then 57 % wide and in sight
    while the others scroll; else in one column, in the `order` of each card, those of the stage after the others."""
    on_the_right = stack(*stage, stylesheets=[SIDE, IN_SIGHT.replace("HEAD", HEAD)])
    return Form(stack(stack(*others, stylesheets=[SIDE]), on_the_right, stylesheets=[STAGED]))


def later(made, place):
    """Sets the position of a card in one column."""
    made.styles = made.styles | {"order": str(place)}
    return made


def flexible(*cards):
    """A row of (card, its CSS flex: growth, shrinkage and least width), which wraps."""
    for each, flex in cards:
        each.styles = each.styles | {"flex": flex, "min-width": "0"}
    return Form(stack(*(each for each, _ in cards), styles=ROOM | WRAPS | {"align-items": "start"}))
