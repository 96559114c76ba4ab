"""What the page does when the server is gone: it says so, waits, and comes back to what the person had set."""

import param

from app.bundle import Bundled


class Connection(Bundled):
    """Once a server answers, the page is loaded anew: its address holds what was set.

    (BokehJS 3.9 can also go on with a session, but fails where the document has arrays, or where a message was cut.)
    """

    words = param.String(constant=True, doc="What it says.")
