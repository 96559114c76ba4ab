"""The Lab: a toy released by hand, on three tables."""
