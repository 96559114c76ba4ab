"""Maps of a sliding top: many runs over two quantities."""
