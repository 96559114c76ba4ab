"""Panel Material UI's design, which works out once for each kind of component in a document what it gives to them."""

from weakref import WeakKeyDictionary

from panel_material_ui import MaterialDesign

GIVEN = WeakKeyDictionary()  # of a document: {kind of component: what the design gives it}


class Design(MaterialDesign):
    """Panel asks for it at each change of each component, and it read files each time: a twelfth of a move."""

    def params(self, viewable, doc=None):
        known = GIVEN.setdefault(doc, {}) if doc is not None else {}
        kind = type(viewable), self.theme
        if kind not in known:
            known[kind] = super().params(viewable, doc)
        return tuple(dict(each) for each in known[kind])
