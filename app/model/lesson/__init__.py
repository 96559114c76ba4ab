"""The lesson: its steps, and the runs that give their answers."""
