"""The first tab: one top, one start, three tables."""
