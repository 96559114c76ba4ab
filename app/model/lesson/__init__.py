"""The lesson: its steps, and the runs that answer them."""
