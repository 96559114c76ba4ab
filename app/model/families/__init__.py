"""A top among others."""
