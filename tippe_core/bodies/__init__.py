"""Bodies that can be made, and their mass properties as a Top."""
