"""What is seen of a Scene that rolls: the plane of its tielines, levers, the derivation, what slips."""
