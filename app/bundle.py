"""What the three-dimensional pictures share: the JavaScript that hatch_build.py bundled, three.js included."""

from pathlib import Path

from panel.custom import JSComponent


class Bundled(JSComponent):
    """A component whose JavaScript is in the bundle; one base class, so that a page loads the bundle once."""

    _bundle = Path(__file__).parent / "static" / "tippe.js"
