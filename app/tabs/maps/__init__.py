"""Maps of many runs of a sliding top."""
