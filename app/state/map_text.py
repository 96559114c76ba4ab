"""A map of runs in the address."""

from app.model.maps.choice import FIXED
from app.model.maps.maps import OWN, QUANTITIES, Map
from app.state.codecs import Number
from tippe_core import PRESETS, TopError


class MapText:
    """A Map in an address: across_from_to_up_from_to_law_body_seconds_cells, then name_value for each fixed
    quantity."""

    @staticmethod
    def text(request):
        """The text of any Map. The page's own top is elsewhere in the address; here it is 0."""
        numbers = (request.seconds, float(request.cells))
        names = [preset.name for preset in PRESETS]
        body = names.index(request.body) + 1 if request.body in names else 0
        parts = [request.across, *map(Number.text, request.across_range),
                 request.up, *map(Number.text, request.up_range), request.law, str(body),
                 *map(Number.text, numbers)]  # fmt: skip
        for name, value in request.values:
            parts += [name, Number.text(value)]
        return "_".join(parts)

    @staticmethod
    def value(text):
        """The Map in a text; else raises ValueError, which may be the TopError of an impossible map."""
        parts = text.split("_")
        if not 10 <= len(parts) <= 10 + 2 * len(QUANTITIES) or len(parts) % 2:
            raise TopError("map", text, "across_from_to_up_from_to_law_body_seconds_cells")
        across, left, right, up, bottom, top, law, which, seconds, cells, *fixed = parts
        number = Number.value
        which = int(number(which))
        body = PRESETS[which - 1].name if 1 <= which <= len(PRESETS) else OWN
        values = tuple((name, number(value)) for name, value in zip(fixed[::2], fixed[1::2], strict=True))
        for name, _ in values:
            if name not in FIXED:
                raise TopError("map", name, ", ".join(FIXED))
        return Map(across=across, up=up, across_range=(number(left), number(right)), law=law,
                   up_range=(number(bottom), number(top)), seconds=number(seconds), cells=int(number(cells)),
                   values=values, body=body)  # fmt: skip
