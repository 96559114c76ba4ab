"""Where the parts of the tab Measure stand."""

from app.text import say
from app.widgets.cards import note, words

PLACES = """
:host { display: grid; gap: 12px 24px; padding: 12px 24px 16px; align-items: start; box-sizing: border-box;
  /* max-content: Panel's columns may shrink to nothing, and an auto row would let them where the window is short */
  grid-template: "over found" max-content "table found" minmax(max-content, 1fr) / minmax(0, 1fr) minmax(300px, 28.6%) }
.over { grid-area: over } .table { grid-area: table } .found { grid-area: found; min-width: 0 }
@media (max-width: 800px) { :host { padding: 12px 16px 16px;
  grid-template: "over" max-content "found" max-content "table" max-content / minmax(0, 1fr) } }
"""


def head(name):
    """The head of a part, with a sentence about it."""
    return words(f"<h2>{say(f'measure.{name}_head')}</h2>{note(say(f'measure.{name}_says'))}", margin=(16, 0, 4, 0))
