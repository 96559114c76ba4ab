"""Words and columns of a Form. They are no models of Bokeh's, and so cost a fiftieth of what Panel's cost; elsewhere on
the page they stand as a pane or a column of Panel's that has the same values."""

import panel as pn
import param


class Light(pn.viewable.Viewer):
    """layout: as of Panel's: margin, sizing_mode, align, width, height, styles, stylesheets."""

    visible = param.Boolean(default=True)
    css_classes = param.List(default=[])
    SHOWS = ("visible", "css_classes")
    _pane = None

    def __init__(self, visible=True, css_classes=(), margin=0, sizing_mode="stretch_width", align="start", width=None,
                 height=None, styles=None, stylesheets=(), **values):  # fmt: skip
        super().__init__(visible=visible, css_classes=[*css_classes], **values)
        self.margin, self.sizing_mode, self.align, self.width, self.height = margin, sizing_mode, align, width, height
        self.styles, self.stylesheets = styles or {}, [*stylesheets]

    def __panel__(self):
        if self._pane is None:
            self._pane = self._made()
            self.param.watch(lambda *events: self._pane.param.update(**self._now()), [*self.SHOWS])
        return self._pane

    def _now(self):
        return {name: getattr(self, name) for name in self.SHOWS}

    def _layout(self):
        names = "margin", "sizing_mode", "align", "width", "height", "styles", "stylesheets"
        return {name: getattr(self, name) for name in names} | self._now()


class Words(Light):
    """HTML."""

    object = param.String(default="")
    SHOWS = (*Light.SHOWS, "object")

    def _made(self):
        return pn.pane.HTML(**self._layout())


class Stack(Light):
    """Parts, one below the other."""

    objects = param.List(default=[], constant=True)

    def _made(self):
        return pn.Column(*self.objects, **self._layout())
