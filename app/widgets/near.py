"""Leaves out drawing what nobody can see."""

import param

from app.bundle import Bundled

OVER = {"position": "absolute", "inset": "0", "z-index": "-1", "pointer-events": "none", "visibility": "hidden"}


class Near(Bundled):
    """Whether the card in which it lies is near the screen."""

    near = param.Boolean(default=True, doc="The browser writes it; until then everything counts as near.")


class WhenNear:
    """A card that is drawn for a scene only while it is near the screen; it catches up when it comes near.

    card: a card; soon: that of a Pacer; draw(scene): draws it.
    """

    def __init__(self, card, soon, draw):
        self._soon, self._draw, self._scene, self._drawn = soon, draw, None, None
        self._sight = Near(styles=OVER, sizing_mode="stretch_both", margin=0)
        card.styles = card.styles | {"position": "relative", "z-index": "0"}
        card.append(self._sight)
        self._sight.param.watch(lambda event: event.new and soon(self._catch_up), "near")

    def show(self, scene):
        """Draws the scene, now or later."""
        self._scene = scene
        if self._sight.near:
            self._catch_up()

    def _catch_up(self):
        if self._scene is not self._drawn:
            self._drawn = self._scene
            self._draw(self._scene)
