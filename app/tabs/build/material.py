"""The choice of what a body is made of, which sets its density."""

from app.model.build.materials import MATERIALS, density_of, material
from app.text import listed, say
from app.widgets.forms import Menu

OTHER = ""  # because a select cannot show that nothing is chosen


class Material:
    """view: a select. choose: called with a density in kg/m^3."""

    def __init__(self, choose):
        self._known = {say("build.bench.of_density", name=says, density=MATERIALS[name]): name
                       for name, says in listed("build.materials").items()}  # fmt: skip
        self.view = Menu(say("build.bench.material"), options=self._known, value="lime")
        self.view.on("value", lambda event: event.new and choose(MATERIALS[event.new]))

    def show(self, shape):
        density, name = density_of(shape), material(shape)
        other = {} if name or density is None else {say("build.bench.other", density=density): OTHER}
        options = other | self._known
        self.view.put(visible=density is not None, options=options, value=name or next(iter(options.values())))
