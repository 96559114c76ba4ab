"""The one start that all rooms share: which view-model computes it in a room, and which room shows its table at the
level "Research". Going to a room sets nothing of the start."""

from app.state.names import PLANES, ROLLING, TOY


class OneStart:
    """The one start that all rooms share. explorer: the Explorer, which is the start; lab: a Lab."""

    def __init__(self, explorer, lab):
        self._explorer, self._lab, self._planes = explorer, lab, None

    def have(self, planes):
        """To be called when the Planes have been created."""
        self._planes = planes

    def moved(self, room):
        """To be called when the page shows a room, given by its name in an address."""
        self._explorer.settle()
        for name, model in ((TOY, self._lab), (PLANES, self._planes)):
            if model and model.begun:
                (model.show if room == name else model.hide)()

    def table(self, name):
        """Sets the table; returns the room that shows it at the level "Research"."""
        self._explorer.table = name
        return self.room

    @property
    def room(self):
        """The room that shows the present table at the level "Research"."""
        return ROLLING if self._explorer.table == "rough" else PLANES

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
        looked_at = self._explorer.table
        return [(plane, motion, picture.settings) for plane, motion in picture.motions.items()
                if motion and looked_at in (plane, "three")]  # fmt: skip
