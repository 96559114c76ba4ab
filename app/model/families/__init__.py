"""A top compared with others."""
