"""Guards along a step: whether one of them falls below 0, and where."""

from ..compiled import compiled, shared_with_kernels
from ..paper.search import fallen
from .contacts import GUARDS, TOUCHES, first_negative, guards
from .dynamics import BALL, NO_ONE, STEM
from .records import Record
from .stepper import at_share

LOOKS = 8  # points of a step at which the guards are evaluated


@compiled
def first_event(W: Record, P: Record, slowest: int) -> tuple[int, float]:
    """The first guard that falls below 0 within the step, or NO_ONE, and the fraction of the step at which it does."""
    before, event, share = 0.0, NO_ONE, 1.0
    for n in range(1, LOOKS + 1):
        x = n / LOOKS
        watched(W, P, slowest, x)
        if first_negative(W.guards) == NO_ONE:
            before = x
            continue
        negative = W.guards < 0
        for i in range(GUARDS):
            if negative[i]:
                at = crossing(W, P, slowest, i, before, x)
                if event == NO_ONE or at < share:
                    event, share = i, at
        break
    return event, share


@compiled
def watched(W: Record, P: Record, slowest: int, x: float) -> None:
    """Computes the guards at the fraction x of the step."""
    C = W.contacts
    at_share(W.step, x, W.step.at)
    guards(W.step.at, slowest, W.modes[BALL], W.modes[STEM], W.floor, P, W.step, C, W.guards)


@shared_with_kernels
def height_or_guard(x: float, W: Record, P: Record, slowest: int, i: int, touches: bool) -> float:
    """Guard i at the fraction x of the step; for one that touches, the height."""
    watched(W, P, slowest, x)
    return W.contacts.height[i - TOUCHES] if touches else W.guards[i]


@compiled
def crossing(W: Record, P: Record, slowest: int, i: int, low: float, high: float) -> float:
    """The fraction of the step, between low and high, at which guard i falls below 0."""
    touches = TOUCHES <= i < TOUCHES + 2 and height_or_guard(low, W, P, slowest, i, True) > 0.0
    if height_or_guard(low, W, P, slowest, i, touches) <= 0.0:
        return low
    return fallen(height_or_guard, low, high, (W, P, slowest, i, touches))
