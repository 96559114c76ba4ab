"""What stands in the page's address, and the way back and forth through it."""
