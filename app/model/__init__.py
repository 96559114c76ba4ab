"""Everything that is computed and stored, without any widget: Scenes, other motions, bodies, the lesson, votes,
runs."""
