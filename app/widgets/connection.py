"""What the page does when the server is gone: it says so, waits, and returns to the state that was set."""

import param

from app.bundle import Bundled


class Connection(Bundled):
    """Once a server answers again, the page is reloaded; its address contains the state.

    (BokehJS 3.9 can also continue a session, but fails if the document has arrays, or if a message was cut off.)
    """

    words = param.String(constant=True, doc="What it says.")
    slow = param.String(constant=True, doc="What it says while the server has not answered for some seconds.")
