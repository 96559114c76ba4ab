"""What a page asks, taken as ours: whoever speaks past the page may send anything in the place of a number."""

import logging
import math

log = logging.getLogger("tippe")


class Unasked(ValueError):
    """Raised for what a page never sends."""


def number(value):
    """A finite float; else Unasked."""
    try:
        if not isinstance(value, bool) and isinstance(value, (int, float)) and math.isfinite(value):
            return float(value)
    except OverflowError:
        pass
    raise Unasked("not a finite number")


def text(value):
    """A str; else Unasked."""
    if isinstance(value, str):
        return value
    raise Unasked("not a text")


def anything(value):
    """Whatever it is."""
    return value


def parts(value, *kinds):
    """A list of one value of each of these kinds, functions such as those above; else Unasked."""
    if not isinstance(value, (list, tuple)) or len(value) != len(kinds):
        raise Unasked(f"not a list of {len(kinds)}")
    return [kind(part) for kind, part in zip(kinds, value, strict=True)]


def heard(act):
    """A watcher that calls act(event), and passes over what a page never sends, with one line in the log."""

    def watcher(event):
        try:
            act(event)
        except Unasked as error:
            pass_over(event, error)

    return watcher


def pass_over(event, error):
    """Says so."""
    log.warning("passed over: %s of a %s: %s", event.name, type(event.obj).__name__, error)
