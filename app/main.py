"""The page for `panel serve app`.

This file is run for each session, and its contents are deleted when the session ends, so nothing that others use may be
created here.
"""

from app.page.page import show

show()
