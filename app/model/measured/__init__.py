"""What a visitor has measured, and the motion that is fitted to it."""
