"""Checks of what a page sends: a client other than the page may send anything in place of a number."""

import logging
import math

log = logging.getLogger("tippe")


class Unasked(ValueError):
    """Raised for a value that a page never sends."""


def number(value):
    """The value as a finite float; else raises Unasked."""
    try:
        if not isinstance(value, bool) and isinstance(value, (int, float)) and math.isfinite(value):
            return float(value)
    except OverflowError:
        pass
    raise Unasked("not a finite number")


def text(value):
    """The value as a str; else raises Unasked."""
    if isinstance(value, str):
        return value
    raise Unasked("not a text")


def anything(value):
    """The value, whatever it is."""
    return value


def parts(value, *kinds):
    """The items of a list, each checked by one of these functions (such as those above); else raises Unasked."""
    if not isinstance(value, (list, tuple)) or len(value) != len(kinds):
        raise Unasked(f"not a list of {len(kinds)}")
    return [kind(part) for kind, part in zip(kinds, value, strict=True)]


def heard(act):
    """A watcher that calls act(event); a value that a page never sends is ignored, with one line in the log."""

    def watcher(event):
        try:
            act(event)
        except Unasked as error:
            pass_over(event, error)

    return watcher


def pass_over(event, error):
    """Writes that line."""
    log.warning("passed over: %s of a %s: %s", event.name, type(event.obj).__name__, error)
