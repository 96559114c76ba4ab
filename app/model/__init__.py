"""What computes and keeps: a Scene of what was set, other motions, bodies, the lesson, votes, long work. No widget."""
