"""Motions in time: on the rough plane, on the smooth plane, and with sliding friction."""
