"""The pages: make docs. Nothing is fetched from outside: furo's fonts are the system's, formulas become MathML."""

import re
from importlib import metadata

import latex2mathml.converter
import matplotlib
from docutils import nodes

project = "Tippe top explorer"
author = copyright = "The tippe top explorer authors"
release = metadata.version("tippe-top-explorer")
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "matplotlib.sphinxext.plot_directive"]
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = project
html_math_renderer = "mathml"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 2
suppress_warnings = ["myst.xref_missing"]  # a page that is also read in the repository links beyond docs
autodoc_member_order = "bysource"
autodoc_typehints = "none"
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


# The start of an entry in a docstring: names, with shapes, then a gap or, after the end of a sentence, a colon.
ENTRY = re.compile(r"(\w+(?: \([^)]*\))?(?:, \w+(?: \([^)]*\))?)*)(:(?= )| {2,})(.*)")


def as_written(app, what, name, obj, options, lines):
    """Docstrings are plain text: nothing in them is markup, each entry is a paragraph, and what is otherwise indented
    keeps its lines. A constant's docstring is that of its type, so docs/api.md describes it instead."""
    if what == "data":
        lines.clear()
    found, literal, entry = [""], False, False
    for line in lines:
        plain, start = escaped(line.strip()), ENTRY.match(line)
        if not plain:
            found.append("")
            entry = False
        elif line.startswith(" ") and entry:
            found[-1] += " " + plain
        elif line.startswith(" "):
            found += ["    " + line] if literal else ["", "::", "", "    " + line]
            literal = True
        else:
            entry = bool(start) and (start[2] != ":" or not found[-1] or found[-1].endswith((".", ";", ":")))
            if entry:
                plain = f"**{escaped(start[1])}{start[2].strip()}** {escaped(start[3].strip())}"
            found += ["", plain] if literal or entry else [plain]
            literal = False
    lines[:] = found


def skipped(app, what, name, obj, skip, options):
    """Skips the fields of named tuples, which have no docstring of their own: the class describes them."""
    return skip or (getattr(obj, "__doc__", None) or "").startswith("Alias for field number")


def escaped(text):
    return re.sub(r"([\\*`|_])", r"\\\1", text)


def setup(app):
    app.add_html_math_renderer("mathml", (mathml("inline"), None), (mathml("block"), None))
    app.connect("autodoc-process-docstring", as_written)
    app.connect("autodoc-skip-member", skipped)
