"""The paper itself: the top, its constants of the motion, f(theta), the forces, and the limits that they set."""
