"""What a rolling top would do at a moment, were its table not rough enough."""

ROLLS, SLIPS, LIFTS = 0, 1, 2
WORDS = ("rolls", "would slip here", "would lift off here")
