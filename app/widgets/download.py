"""A button that saves a file, which is made in a thread when it is clicked."""

import base64
from functools import partial

import param

from app.bundle import Bundled
from app.model.runs import FILES, Run, Stopped


class Download(Bundled):
    """runs: the page's Runs. state: returns the arguments of make at the time of the click; make: returns the file's
    bytes.

    Clicks while a file is being made give one file, with the state and the name at the last click.
    """

    label = param.String(constant=True)
    filename = param.String()
    clicks = param.Integer(default=0, doc="the browser counts them")
    file = param.List(default=[0, "", ""], doc="[number of files so far, the newest one in base64, its name]")
    disabled = param.Boolean(default=False)
    making = param.Boolean(default=False)
    SENDS = ("clicks",)

    def __init__(self, runs, state, make, **params):
        super().__init__(**params)
        self._runs, self._state, self._make, self._requested = runs, state, make, None
        self.param.watch(self._clicked, "clicks")

    def _clicked(self, event):
        request = self.filename, self._state()
        if self.making and request == self._requested:
            return
        self._requested, self.making = request, True
        name, state = request
        self._runs.begin(Run(lambda run: self._make(*state), partial(self._made, name)), f"file {id(self)}", FILES)

    def _made(self, name, result):
        self.making = False
        if not isinstance(result, Exception):
            self.file = [self.file[0] + 1, base64.b64encode(result).decode(), name]
        elif not isinstance(result, Stopped):
            raise result
