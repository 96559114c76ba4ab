"""A place on a map as a start by hand in the Lab."""

from app.model.maps.maps import OF_BODY, OWN, Map
from app.model.setup import PATCH, TOYS


def throw_of(request: Map, across: float, up: float) -> tuple[str, float, float, float] | None:
    """(toy, spin in rev/s, tilt in degrees, mu); None if the Lab has no such run."""
    x = request.values_at(across, up)
    same = request.law == "contensou" and abs(x["second"] - PATCH) < 1e-9 and x["slip"] == 1.0
    if request.body == OWN or request.body not in TOYS or {request.across, request.up} & OF_BODY or not same:
        return None
    return request.body, x["spin"], x["tilt"], x["mu"]
