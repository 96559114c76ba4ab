"""`python -m app`: see app.server.server."""

import logging
import os
import signal
import sys

from app.server.settings import Settings


def run():
    # In a container nobody else ends the first process, and what is imported here takes its time.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        settings = Settings.of(os.environ, sys.argv[1:])
    except ValueError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    from app.model.classroom import DESK
    from app.server.server import main

    DESK.keep(settings.votes, settings.votes_per_address)
    code = main(settings)
    logging.shutdown()
    os._exit(code)  # nothing is left to save, and taking all modules apart takes seconds


if __name__ == "__main__":
    run()
