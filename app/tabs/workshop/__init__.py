"""Build a top."""
