"""Checks of what a page sends: a client other than the page may send anything in place of a number."""

import logging
import math

log = logging.getLogger("tippe")


class InvalidMessage(ValueError):
    """Raised for a value that a page never sends."""


def number(value):
    """The value as a finite float; else raises InvalidMessage."""
    try:
        if not isinstance(value, bool) and isinstance(value, (int, float)) and math.isfinite(value):
            return float(value)
    except OverflowError:
        pass
    raise InvalidMessage("not a finite number")


def text(value):
    """The value as a str; else raises InvalidMessage."""
    if isinstance(value, str):
        return value
    raise InvalidMessage("not a text")


def anything(value):
    """The value, whatever it is."""
    return value


def parts(value, *kinds):
    """The items of a list, each checked by one of these functions (such as those above); else raises InvalidMessage."""
    if not isinstance(value, (list, tuple)) or len(value) != len(kinds):
        raise InvalidMessage(f"not a list of {len(kinds)}")
    return [kind(part) for kind, part in zip(kinds, value, strict=True)]


def handler(act):
    """A watcher that calls act(event); a value that a page never sends is ignored, with one line in the log."""

    def watcher(event):
        try:
            act(event)
        except InvalidMessage as error:
            log_invalid(event, error)

    return watcher


def log_invalid(event, error):
    """Writes that line."""
    log.warning("passed over: %s of a %s: %s", event.name, type(event.obj).__name__, error)
