"""Three planes: one top on a smooth, a rough and a sliding plane."""
