"""`panel serve app` finds the page here.

This is run for each session, and emptied when the session ends; so nothing that others use may be made here.
"""

from app.page.page import show

show()
