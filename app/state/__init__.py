"""The state of the page in its address, undo and redo, and checks of what a browser sends."""
