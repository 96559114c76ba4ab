"""Events: what happens, and at which contact (where it is the whole top's, BALL)."""

from typing import TypeAlias

Event: TypeAlias = tuple[int, int]
Modes: TypeAlias = tuple[int, int]  # of ball and stem
# A guard falls below 0 (contacts.py): no normal force balances friction; a contact leaves, slips, touches; the top
# stands on its stem, its far side comes down, the sphere's surface ends. A contact comes to rest. The start.
BALANCES, LEAVES, SLIPS, TOUCHES, STANDS_UP, ROCKS, RIM, HALTS, STARTS = range(9)
NONE = -1
