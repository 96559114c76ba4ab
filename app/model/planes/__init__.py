"""One top on the three planes, with friction."""
