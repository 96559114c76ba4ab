"""The pages: make docs. Nothing is fetched from outside: furo's fonts are the system's, formulas become MathML."""

import re
from importlib import metadata

import latex2mathml.converter
import matplotlib
from docutils import nodes

project = "Tippe top explorer"
author = copyright = "The tippe top explorer authors"
release = metadata.version("tippe-top-explorer")
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "matplotlib.sphinxext.plot_directive"]
exclude_patterns = ["_build", "upstream"]  # reports to other projects, for who changes app/borrowed.py
html_theme = "furo"
html_title = project
html_math_renderer = "mathml"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 2
nb_execution_mode = "force"  # the notebooks are kept without their output
nb_execution_raise_on_error = True
nb_execution_timeout = 120  # s, for each cell
suppress_warnings = ["myst.xref_missing"]  # a page that is also read in the repository links beyond docs
autodoc_member_order = "bysource"
autodoc_typehints = "none"
# Names that share a line stay together, and an attribute that is a property too has one entry in the index.
napoleon_custom_sections = [("Parameters", "params_style"), ("Attributes", "params_style")]
autodoc_default_options = {"members": True}
plot_include_source = True
plot_html_show_source_link = plot_html_show_formats = False
plot_formats = ["svg"]
plot_rcparams = {"figure.figsize": (6.4, 4.2), "svg.hashsalt": "tippe", "axes.grid": True, "grid.alpha": 0.3}
plot_apply_rcparams = True
matplotlib.use("svg")


def mathml(display):
    def visit(self, node):
        self.body.append(latex2mathml.converter.convert(node.astext(), display=display))
        raise nodes.SkipNode

    return visit


def as_written(app, what, name, obj, options, lines):
    """Nothing in a docstring is markup but the names of its sections, which napoleon reads after this; before the first
    section, what is indented keeps its lines. A constant's docstring is that of its type, so docs/api.md describes it
    instead."""
    found, literal, prose = [], False, True
    for line in [] if what == "data" else lines:
        prose = prose and not re.fullmatch("-+", line)
        indented = prose and line.startswith(" ")
        if indented and not literal:
            found += ["", "::", ""]
        elif literal and line and not indented:
            found.append("")
        literal = indented or (literal and not line)
        found.append("    " + line if indented else escaped(line))
    lines[:] = found
    if what == "property":
        written[name] = found


written = {}


def whole(app, what, name, obj, options, lines):
    """Napoleon takes what precedes a colon in a property's docstring for its type."""
    lines[:] = written.get(name, lines)


def skipped(app, what, name, obj, skip, options):
    """Skips the fields of named tuples, which have no docstring of their own: the class describes them."""
    return skip or (getattr(obj, "__doc__", None) or "").startswith("Alias for field number")


def escaped(text):
    """With the code in it as code, and without the enumerations that equation numbers would be."""
    words = text.split("`")
    words[1::2] = [f"``{code}``" for code in words[1::2]]
    words[::2] = [re.sub(r"([\\*|_])", r"\\\1", plain) for plain in words[::2]]
    return re.sub(r"^( *)(?=\(\w+\))", r"\1\\", "".join(words))


def setup(app):
    app.add_html_math_renderer("mathml", (mathml("inline"), None), (mathml("block"), None))
    app.connect("autodoc-process-docstring", as_written, priority=400)  # before napoleon, which has 500
    app.connect("autodoc-process-docstring", whole, priority=600)
    app.connect("autodoc-skip-member", skipped)
