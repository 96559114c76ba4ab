"""The page: what stands on it, and the picture before the session."""
