"""The Lab: a toy let go by a hand, on three tables."""
