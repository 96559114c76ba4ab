"""Results derived from a Scene of rolling: the plane of the tielines, lever arms, the derivation, what slipping
does."""
