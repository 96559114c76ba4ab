"""What somebody measured, and the motion that is fitted to it."""
