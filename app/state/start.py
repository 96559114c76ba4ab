"""Moving between rooms: which of the page's view-models is shown, and the table of the common start."""

from app.model.start import PLANE

TOY, ROLLING, PLANES = "lab", "roll", "three-planes"


class OneStart:
    """The one start that all rooms share. explorer: the Explorer, which is the start; lab: a Lab."""

    def __init__(self, explorer, lab):
        self._explorer, self._lab, self._planes = explorer, lab, None

    def have(self, planes):
        """To be called when the Planes have been created."""
        self._planes = planes

    def moved(self, left, room):
        """To be called when the page changes from one room to another, given by their names in an address."""
        self._explorer.settle()
        if room == ROLLING or (left, room) == (ROLLING, TOY):
            self._explorer.table = "rough"
        for name, model in ((TOY, self._lab), (PLANES, self._planes)):
            if model and model.begun:
                (model.show if room == name else model.hide)()

    def table(self, name):
        """Sets the table; returns the room that shows it at the level "Explore"."""
        self._explorer.table = name
        return ROLLING if name == "rough" else PLANES

    def busy(self, room):
        """Whether this room is about to show other runs."""
        model = {TOY: self._lab, PLANES: self._planes}.get(room)
        return model is not None and model.busy

    def lab_runs(self):
        """(table, its motion, its start) of each table that the Lab shows."""
        scene = self._lab.scene
        return [(table, motion, motion.start) for table, motion in scene.motions.items() if motion] if scene else []

    def planes_runs(self):
        """The same for the planes that are shown."""
        picture = self._planes.picture if self._planes else None
        if picture is None:
            return []
        looked_at = PLANE[self._explorer.table]
        return [(plane, motion, picture.settings) for plane, motion in picture.motions.items()
                if motion and looked_at in (plane, "compare")]  # fmt: skip
