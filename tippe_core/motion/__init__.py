"""What a top does in time, on the rough plane, on the smooth one, and where it slides."""
