"""One folder for each tab; they do not import each other."""
