"""The page: its views, and the picture before the session has started."""
