"""Learn: the lesson, the derivation, and the pages for a teacher and a class."""
