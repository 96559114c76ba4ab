"""The log: one line for each event, as text or JSON, with or without the addresses of visitors."""

import json
import logging
import platform
import re
import sys
import time
from contextlib import suppress
from ipaddress import ip_address

from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError

# Anything that may be an IPv4 or IPv6 address.
WORD = re.compile(r"(?<![\w.:])[0-9a-fA-F]*[.:][0-9a-fA-F.:]*[0-9a-fA-F:](?![\w])")


def without_addresses(line):
    """The line with - in place of each address and its port."""

    def replaced(found):
        word = found[0]
        for text in (word, word.rpartition(":")[0]):
            with suppress(ValueError):
                ip_address(text)
                return "-:" if word[-1] == ":" and text != word else "-"
        return word

    return WORD.sub(replaced, line)


AGAIN = 10.0  # s
MOST = 10_000  # that are remembered


class Seldom(logging.Filter):
    """Lets the same refusal of the same address through once in AGAIN, with how often it was held back before, so that
    no visitor can fill the log. A record is such a refusal if it has `seldom`: the address, and the reason. errors: how
    many lines of error there were."""

    def __init__(self):
        super().__init__()
        self.errors = 0
        self._passed = {}  # (address, reason) -> (when it was let through, how often it was not since)

    def filter(self, record):
        self.errors += record.levelno >= logging.ERROR
        of = getattr(record, "seldom", None)
        if of is None:
            return True
        now = time.monotonic()
        when, held = self._passed.get(of, (-AGAIN, 0))
        if now - when < AGAIN:
            self._passed[of] = when, held + 1
            return False
        if len(self._passed) > MOST:
            self._passed = {
                each: entry for each, entry in self._passed.items() if now - entry[0] < AGAIN and each != of
            }
        self._passed[of] = now, 0
        if held:
            record.msg, record.args = f"{record.getMessage()} ({held} more like this before)", ()
        return True


SELDOM = Seldom()  # of this process


def refused(address, why, line, *values):
    """Logs a refusal for the reason `why`; values: of the line's places, in which a visitor may write what he likes."""
    logging.getLogger("tippe").warning(line, *values, extra={"seldom": (address, why)})


class Line(logging.Formatter):
    """Formatter of lines of text or JSON."""

    def __init__(self, as_json, addresses):
        super().__init__(f"%(asctime)s %(levelname)s {platform.node()} %(process)d %(message)s")
        self._json, self._addresses = as_json, addresses

    def format(self, record):
        line = super().format(record)
        message = record.getMessage()
        if not self._addresses:
            line, message = without_addresses(line), without_addresses(message)
        if not self._json:
            return line
        when = self.formatTime(record, "%Y-%m-%dT%H:%M:%S%z")
        entry = {"time": when, "level": record.levelname, "host": platform.node(), "process": record.process,
                "logger": record.name, "message": message}  # fmt: skip
        if record.exc_info:
            trace = self.formatException(record.exc_info)
            entry["trace"] = trace if self._addresses else without_addresses(trace)
        return json.dumps(entry, ensure_ascii=False)


def begin(settings):
    """Sets up the log, to stdout."""
    sys.stdout.reconfigure(errors="backslashreplace")  # an invalid character from a visitor must not break the log
    logging.basicConfig(stream=sys.stdout, level=logging.WARNING, force=True)
    logging.captureWarnings(True)
    [handler] = logging.getLogger().handlers
    handler.addFilter(SELDOM)
    handler.setFormatter(Line(settings.log_format == "json", settings.log_addresses))
    logging.getLogger("tippe").setLevel(settings.log.upper())
    sys.excepthook = lambda *error: logging.getLogger("tippe").critical("the server cannot go on", exc_info=error)
    for name in ("bokeh", "panel"):  # their own handlers write to another stream, in another form
        logging.getLogger(name).handlers.clear()
        logging.getLogger(name).setLevel("CRITICAL")  # their errors are logged by note()
    if settings.log == "debug":
        logging.getLogger("tornado.access").setLevel(logging.INFO)


def unheard(loop, context):
    """Handler of unawaited exceptions: that a page closed while something was on its way to it is no error."""
    if not isinstance(context.get("exception"), (WebSocketClosedError, StreamClosedError)):
        loop.default_exception_handler(context)
