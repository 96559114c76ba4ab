"""What a top does at a moment, or would do were its table no rougher than it is. A motion's frames hold the codes."""

ROLLS, WOULD_SLIP, WOULD_LIFT, SLIPS, FLIES, ENDS = range(6)
WORDS = ("rolls", "would slip here", "would lift off here", "slips", "in the air", "the motion ends here")
"""By their codes; browser.toml says them."""
