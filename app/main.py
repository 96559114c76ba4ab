"""`panel serve app` finds the page here.

This is run for each session, and emptied when the session ends; so nothing that others use may be made here.
"""

import panel as pn

from app.page import alone, page

pn.extension("katex", respect_explicit_sizing=True)
alone(page()).servable()
