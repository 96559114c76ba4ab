"""What the components in the browser share: the JavaScript bundle of hatch_build.py, which includes three.js; their
words; and Bokeh's callbacks into it.

Panel serves only files beside or below a component's own module, so this module is beside static/.
"""

import base64
import json
from pathlib import Path

import numpy as np
import param
from bokeh.models import CustomJS
from panel.custom import JSComponent
from panel.io.resources import component_resource_path
from param.parameterized import no_instance_params

from app.text import listed
from app.together import set_together

BUNDLE = Path(__file__).parent / "static" / "tippe.js"
ENCODERS = BUNDLE.with_name("encoders.js")


def pack(values):
    """The values as float32 bytes, row by row, as the array parameters of components need them."""
    return np.asarray(values, "<f4").tobytes()


def address_of(kind, path):
    """The address of a component's file, as Panel says it to the page, so that the browser can request it before."""
    return f"./{component_resource_path(kind, '_bundle_path', path)}"


def code_of(path):
    """A short script without its comments: a page has it a hundred times."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line for line in lines if not line.startswith("//"))


class Encoders:
    """Tells Panel's server where the writers of films are, which a browser fetches when it makes one."""

    _bundle_path = ENCODERS


# It runs a function of frontend/src/figures/callbacks.js: `run` is its name, and `given` its first argument.
CALL = code_of(Path(__file__).with_name("call.js"))


def call(run, **given):
    """A callback of a Bokeh model."""
    return CustomJS(args={"run": run, "given": given}, code=CALL, module=False)


def classic(**found):
    """A classic script that calls functions of the bundle, each with the JSON of what was found: for pages that are
    opened as files, which load no modules."""
    inside, _, exported = BUNDLE.read_text(encoding="utf-8").rpartition("export{")
    calls = "".join(f"tippe.{name}({json.dumps(as_json(values))});" for name, values in found.items())
    return f"{{const tippe=(function(){{'use strict';{inside}return {exported.split()[0]}}})();{calls}}}\n"


def values_of(part):
    """{parameter: value} of a component, for a page without a server."""
    return {name: getattr(part, name) for name in type(part).param if name not in Bundled.param or name == "texts"}


def as_json(found):
    """JSON for use inside a script of a page; bytes are {"base64": text}, which `valued` of data.js reads."""
    return json.dumps(found, default=_coded).replace("<", "\\u003c")  # no end tag of a script, and no comment


def _coded(value):
    return value.item() if isinstance(value, np.generic) else {"base64": base64.b64encode(value).decode()}


def inlined(path):
    """A script for use between <script> and its end in a page; its names are local to it."""
    return f"{{\n{path.read_text(encoding='utf-8')}}}"


class Bundled(JSComponent):
    """A component whose JavaScript is in the bundle; a common base class, so that a page loads the bundle once."""

    texts = param.Dict(default={}, constant=True, doc="Its own words: under SAYS in browser.toml.")
    SAYS = ()  # tables of words that it needs in addition to that of its own name
    REGIMES = ""  # a table of regimes.toml, which it gets as `regimes`
    _last = None

    _bundle = BUNDLE

    def __init__(self, **params):
        no_instance_params(type(self))  # a copy of each parameter for each part was half the cost of making it
        super().__init__(**({"texts": self.says()} | params))

    def tell(self, **values):
        """Sets several values as one change."""
        set_together(self, **values)

    def is_new(self, what):
        """Whether this differs from the last `what`, which it then replaces."""
        new, self._last = self._last is not what, what
        return new

    @classmethod
    def says(cls, language=None):
        """Its texts in a language, by default that of the page."""
        known, texts = listed("browser", language), {}
        for name in (*cls.SAYS, cls.__name__):
            texts |= known.get(name, {})
        return texts | ({"regimes": listed(f"regimes.{cls.REGIMES}", language)} if cls.REGIMES else {})
