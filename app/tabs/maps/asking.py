"""The inputs of a map: selects, and entries to type into; together they give a Map."""

from dataclasses import replace
from functools import partial

from app.model.maps.choice import FIXED
from app.model.maps.maps import COLOURS_BY, LAWS, MOST_CELLS, MOST_SECONDS, QUANTITIES, SECONDS, Map
from app.tabs.maps.words import with_unit
from app.text import listed, say, written
from app.widgets.cards import Hidden, flow, words
from app.widgets.forms import Field, Menu, typed_number

SIDES = "across", "up"
LIMITS = ("from", "to")


class Settings:
    """changed: called after an input was set by hand; gone: after another position of the bead was typed."""

    def __init__(self, request, colour, place, changed, gone):
        self._changed, self._gone, self._last = changed, gone, ""
        quantities = {says: name for name, says in listed("maps.quantities").items()}
        colours, laws = listed("maps.colours"), listed("maps.laws")
        options = {"across": quantities, "up": quantities, "colour": {colours[name]: name for name in COLOURS_BY},
                   "law": {laws[name]: name for name in LAWS}}  # fmt: skip
        self.choices = {name: Menu(say(f"maps.{name}"), options=each, value=next(iter(each.values())))
                        for name, each in options.items()}  # fmt: skip
        called, spoken = listed("maps.quantities"), {"seconds": say("maps.seconds"), "cells": say("maps.cells")}
        spoken |= {name: called[name] for name in FIXED}
        for side in SIDES:
            spoken |= {f"{side}_{end}": f"{say(f'maps.{side}')}, {say(f'maps.{end}')}" for end in LIMITS}
            spoken[f"here_{side}"] = f"{say('maps.here')}, {say(f'maps.{side}')}"
        shows = {f"{side}_{end}": say(f"maps.{end}") for side in SIDES for end in LIMITS}
        shows |= {name: say(f"maps.{name}") for name in ("seconds", "cells")}
        self.entries = {name: Field(says, shows=shows.get(name, "")) for name, says in spoken.items()}
        self.deep = Hidden(self._deep)
        self.show(request, colour, place)
        for name, select in self.choices.items():
            select.on("value", partial(self._chosen, name))
        for name, entry in self.entries.items():
            entry.on("value", partial(self._typed, name))

    @property
    def view(self):
        """The axes and the colour; then what is open at the level Research."""
        return [flow(*(self.choices[name] for name in ("across", "up", "colour"))), self.deep]

    def _deep(self):
        """The law, the ranges and numbers."""
        entry = self.entries
        ranges = [flow(words(say(f"maps.{side}"), sizing_mode=None, width=80, align="center"),
                       *(entry[f"{side}_{end}"] for end in LIMITS), margin=(4, 0))
                  for side in SIDES]  # fmt: skip
        rows = [*ranges, flow(*(entry[name] for name in FIXED)), flow(*(entry[name] for name in ("seconds", "cells")))]
        return [flow(self.choices["law"]), *rows]

    @property
    def place_view(self):
        """The position of the bead."""
        label = words(say("maps.here"), sizing_mode=None, align="center")
        return flow(label, *(self.entries[f"here_{side}"] for side in SIDES), margin=(4, 0))

    def show(self, request, colour, place):
        """Shows all inputs of a Map, the colour and the bead."""
        self._slides = {"body": request.body, "own": request.own}
        for name, value in (("across", request.across), ("up", request.up), ("colour", colour), ("law", request.law)):
            self.choices[name].put(value=value)
        self._write_spans(*spans(request))
        self._write(
            {name: request.start[name] for name in FIXED} | {"seconds": request.seconds, "cells": request.cells}
        )
        self.show_place(place)
        self._show_rows()
        self._good = {name: entry.value for name, entry in self.entries.items()}
        self.accept()

    def show_place(self, place):
        self._write({f"here_{side}": x for side, x in zip(SIDES, place, strict=True)})

    def look_at(self, across, up):
        """Sets other ranges."""
        self._last = ""
        self._write_spans(across, up)
        self._changed()

    def request(self):
        """The present inputs, as a Map; raises ValueError, TopError."""
        value = {name: self._number(name) for name in self.entries if not name.startswith("here")}
        chosen = {name: select.value for name, select in self.choices.items()}
        axes = (chosen["across"], chosen["up"])
        cells = value["cells"]
        request = Map(**self._slides, across=axes[0], up=axes[1], law=chosen["law"],
                    across_range=(value["across_from"], value["across_to"]),
                    up_range=(value["up_from"], value["up_to"]), seconds=value["seconds"],
                    cells=int(cells) if cells.is_integer() else cells)  # fmt: skip
        usual = request.start
        fixed = tuple((name, value[name]) for name in FIXED if name not in axes and value[name] != usual[name])
        return replace(request, values=fixed)

    def place(self):
        """The position of the bead that was typed; raises ValueError."""
        return [self._number(f"here_{side}") for side in SIDES]

    # ---- what cannot be ----

    def refuse(self, why):
        """Says it at the entry that was typed last, with the nearest possible number; returns whether there is one."""
        if not self._last:
            return False
        self.entries[self._last].refuse(why, *self._ways(self._last))
        return True

    def accept(self):
        """Nothing is wrong any more."""
        self._last = ""
        for entry in self.entries.values():
            entry.refuse()

    def _ways(self, name):
        """(the nearest possible number for an entry, the last good one), as they are typed."""
        good = self._good[name]
        try:
            value = typed_number(self.entries[name].value)
        except ValueError:
            return "", good
        side, _, end = name.partition("_")
        if name == "cells":
            near = min(max(3 * round(value / 3), 3), MOST_CELLS)
        elif name == "seconds":
            near = min(max(value, 0.1), MOST_SECONDS)
        else:
            of = QUANTITIES[self.choices[side].value if end else name]
            near = min(max(value, of.least), of.most)
        return ("" if near == value else written(near, ".5g")), good

    # ---- input by hand ----

    def _chosen(self, name, event):
        self._last = ""
        if name in SIDES:
            quantity = QUANTITIES[event.new]
            self._write({f"{name}_from": quantity.low, f"{name}_to": quantity.high})
        if name == "law":
            self._write({"second": Map(law=event.new).start["second"]})
        self._show_rows()
        self._changed()

    def _typed(self, name, event):
        self._last = name
        (self._gone if name.startswith("here") else self._changed)()

    def _show_rows(self):
        taken, law = (self.choices["across"].value, self.choices["up"].value), self.choices["law"].value
        for name in FIXED:
            is_asked = name not in taken and (name != "second" or bool(SECONDS[law]))
            self.entries[name].param.update(visible=is_asked, shows=_called(name, law))

    def _write(self, values):
        for name, value in values.items():
            self.entries[name].put(value=written(value, ".5g"))

    def _write_spans(self, *of_sides):
        self._write({f"{side}_{end}": float(x) for side, span in zip(SIDES, of_sides, strict=True)
                     for end, x in zip(LIMITS, span, strict=True)})  # fmt: skip

    def _number(self, name):
        text = self.entries[name].value
        try:
            return typed_number(text)
        except ValueError:
            raise ValueError(say("maps.not_a_number", name=name, text=text)) from None


def spans(request):
    """The ranges of a Map, across and up."""
    return request.across_range, request.up_range


def _called(name, law):
    return listed("maps.seconds_of")[law] if name == "second" else with_unit(name)
