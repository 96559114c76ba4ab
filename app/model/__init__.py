"""Everything that is computed and stored, without any widget: Scenes, other motions, bodies, the lesson, votes,
runs."""

from typing import Any


def tell(query: str = "", language: str = "en") -> dict[str, Any]:
    """What the page says of a link, as data: see app.model.telling.told."""
    from app.state.telling import tell  # which is above this package, because it reads links

    return tell(query, language)  # type: ignore[no-untyped-call]
