"""Bodies that a person can make, and what they are as a Top."""
