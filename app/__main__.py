"""`python -m app`: see app.server.server; `python -m app site DIR`: see app.page.site."""

import logging
import os
import signal
import sys
from pathlib import Path

from app.server.settings import Settings


def run():
    # In a container nothing else ends the first process, and the imports below take some time.
    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, lambda *_: sys.exit(0))
    if sys.argv[1:2] == ["site"]:
        from app.page.site import main as write

        sys.exit(write(sys.argv[2:]))
    try:
        settings = Settings.of(os.environ, sys.argv[1:])
    except ValueError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    from app.model.maps.kept import keep_in
    from app.model.votes.desk import DESK
    from app.page.page import show
    from app.server.server import main
    from app.share.parts import Embed
    from app.widgets.guide import RESPONSIBLE

    Embed.param.frames.default = settings.frames
    RESPONSIBLE["who"] = settings.responsible
    DESK.keep(settings.votes, settings.votes_per_address)
    if settings.maps:
        keep_in(Path(settings.maps))
    try:
        code = main(settings, show)
    except SystemExit as end:
        code = end.code
    logging.shutdown()
    os._exit(code)  # nothing is left to save, and Python takes seconds to unload all modules


if __name__ == "__main__":
    run()
