"""The paper itself: the top, its constants of the motion, f(theta), the forces, and how far they let it go."""
