"""Learn: the lesson, the derivation, and what a teacher and a class have."""
