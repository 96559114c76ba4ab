"""Votes of a class, and where they are stored."""
