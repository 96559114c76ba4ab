"""Panel Material UI's design, but what it gives to a kind of component is computed only once for each document."""

from weakref import WeakKeyDictionary

from panel_material_ui import MaterialDesign

GIVEN = WeakKeyDictionary()  # document -> {kind of component: what the design gives to it}


class Design(MaterialDesign):
    """Panel asks for these values at each change of each component, and reads files each time, a twelfth of the cost of
    a move."""

    def params(self, viewable, doc=None):
        known = GIVEN.setdefault(doc, {}) if doc is not None else {}
        kind = type(viewable), self.theme
        if kind not in known:
            known[kind] = super().params(viewable, doc)
        return tuple(dict(each) for each in known[kind])
